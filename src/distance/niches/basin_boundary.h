#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "concave_distance/base/work_limit.h"
#include "facet_pair_neighbours.h"

namespace concave_distance::detail {

/// An element that parts a set of facet pairs from one beyond it.
struct BorderElement {
  SharedElement shared;
  TriangleIndex beyond;  ///< facet of the body that has the edge; with `shared.other` the facet pair beyond

  TrianglePair pairBeyond() const {
    return shared.side == Side::A ? TrianglePair{beyond, shared.other} : TrianglePair{shared.other, beyond};
  }
};

/// Where the borders of a pair keep their elements, in groups of one measurement. Freed groups are used
/// again, so that nothing is allocated once as many as ever are there.
class BorderPool {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffU;
  static constexpr std::size_t kWidth = 16;

  /// In single precision.
  struct Chunk {
    std::array<float, kWidth> gap;
    std::array<float, kWidth> lever;
    std::array<std::array<float, kWidth>, 3> direction;  ///< fixed body's axes; of directed ones
    std::array<BorderElement, kWidth> elements;
    std::uint32_t count = 0;
    std::uint32_t next = kNone;
  };
  struct Entry {
    float gap;
    float lever;
    Eigen::Vector3f direction;
    BorderElement element;
  };
  struct Directed {
    Side fixed_in;
    Entry entry;
  };

  /// An empty group before `next`; kNone without memory.
  std::uint32_t take(std::uint32_t next, WorkLimit& limit);
  /// The group and all after it.
  void release(std::uint32_t first);
  Chunk& operator[](std::uint32_t chunk) { return (*blocks_[chunk / kBlockSize])[chunk % kBlockSize]; }
  const Chunk& operator[](std::uint32_t chunk) const {
    return (*blocks_[chunk / kBlockSize])[chunk % kBlockSize];
  }

  void clear();
  std::size_t memoryBytes() const;

  // Of one look at a border.
  std::vector<Directed> anew;
  std::vector<BorderElement> crossed;

 private:
  static constexpr std::uint32_t kBlockSize = 64;
  using Block = std::array<Chunk, kBlockSize>;

  std::vector<std::unique_ptr<Block>> blocks_;  ///< borders of large regions would be slow to copy
  std::uint32_t chunk_count_ = 0;
  std::uint32_t free_ = kNone;
};

/// Encloses a set of facet pairs by elements over which the distance is at least a level. At another
/// pose the distance over an element has changed by no more than one point has moved and the turn times a
/// lever; where that is not enough it is measured anew, and from then on the gap along the direction of the
/// closest points is what counts, which the motion across it leaves as it is. No history: what holds is seen
/// at the pose itself.
class BasinBoundary {
 public:
  /// An empty one around a point of each body, own axes in the frame's centre.
  void begin(BorderPool& pool, const Eigen::Vector3d& centre_a, const Eigen::Vector3d& centre_b);
  void clear(BorderPool& pool);

  /// @param level metres, of the distance over the element at this pose. False without memory.
  bool add(BorderPool& pool, const PairFrame& frame, const BorderElement& element, double level,
           WorkLimit& limit);

  /// Looks for elements over which the distance is below `level` (metres): they leave the border and are
  /// `pool.crossed`.
  /// @return elements measured
  std::uint32_t takeCrossed(BorderPool& pool, const PairFrame& frame, double level);

  std::size_t size(const BorderPool& pool) const;

 private:
  /// Elements measured at one pose, seen from the axes of one body while the other one moves, whose part of
  /// each lies within the lever of its centre.
  struct Batch {
    Side fixed_in = Side::A;
    bool directed = false;
    Eigen::Matrix3d rotation;  ///< of the frame's frame, at the pose
    Eigen::Vector3d offset;
    float longest = 0.0F;  ///< lever
    std::uint32_t first = BorderPool::kNone;
  };
  static constexpr std::uint32_t kMostBatches = 8;
  class Bound;
  struct Levers;

  /// There must be room for one more.
  Batch& batchAt(const PairFrame& frame, Side fixed_in, bool directed);
  /// The place for another element; kNone without memory.
  static std::uint32_t placeIn(BorderPool& pool, Batch& batch, WorkLimit& limit);
  static BorderPool::Entry takeFrom(BorderPool::Chunk& chunk, std::uint32_t k);
  /// False without memory.
  static bool put(BorderPool& pool, Batch& batch, const BorderPool::Entry& entry, WorkLimit& limit);
  std::uint32_t look(BorderPool& pool, const PairFrame& frame, Batch& batch, double level) const;
  void rebase(BorderPool& pool, const PairFrame& frame);

  std::array<Eigen::Vector3d, 2> centres_;
  std::array<Batch, kMostBatches> batches_;
  std::uint32_t used_ = 0;  ///< batches
};

}  // namespace concave_distance::detail
