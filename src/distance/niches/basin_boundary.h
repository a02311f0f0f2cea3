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
struct BoundaryElement {
  SharedElement shared;
  TriangleIndex beyond;  ///< facet of the body that has the edge; with `shared.other` the facet pair beyond

  TrianglePair pairBeyond() const {
    return shared.side == Side::A ? TrianglePair{beyond, shared.other} : TrianglePair{shared.other, beyond};
  }
};

/// Keeps the elements of a pair's boundaries, in groups of one measurement. Freed groups are used
/// again, so that nothing is allocated once as many as ever are there.
class BoundaryPool {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffU;
  static constexpr std::size_t kWidth = 16;

  /// Elements measured together; all numbers are in single precision.
  struct Chunk {
    std::array<float, kWidth> gap;
    std::array<float, kWidth> radius;
    std::array<std::array<float, kWidth>, 3>
        direction;  ///< unit vector, axes of the body that is fixed; only in directed batches
    std::array<BoundaryElement, kWidth> elements;
    std::uint32_t count = 0;
    std::uint32_t next = kNone;
  };
  struct Entry {
    float gap;
    float radius;
    Eigen::Vector3f direction;
    BoundaryElement element;
  };
  struct Directed {
    Side fixed_in;
    Entry entry;
  };

  /// Returns an empty group that precedes `next`, or kNone without memory.
  std::uint32_t take(std::uint32_t next, WorkLimit& limit);
  /// Frees the group and all after it.
  void release(std::uint32_t first);
  Chunk& operator[](std::uint32_t chunk) { return (*blocks_[chunk / kBlockSize])[chunk % kBlockSize]; }
  const Chunk& operator[](std::uint32_t chunk) const {
    return (*blocks_[chunk / kBlockSize])[chunk % kBlockSize];
  }

  void clear();
  std::size_t memoryBytes() const;

  // Results of the last BasinBoundary::takeCrossed().
  std::vector<Directed> anew;
  std::vector<BoundaryElement> crossed;

 private:
  static constexpr std::uint32_t kBlockSize = 64;
  using Block = std::array<Chunk, kBlockSize>;

  std::vector<std::unique_ptr<Block>> blocks_;  ///< the boundary of a large basin would be slow to copy
  std::uint32_t chunk_count_ = 0;
  std::uint32_t free_ = kNone;
};

/// Encloses a set of facet pairs by elements over which the distance is at least a level. At another
/// pose the distance over an element has changed by no more than one point has moved and the turn times a
/// radius; where that is not enough it is measured anew, and from then on the gap along the direction of the
/// closest points is what counts, which the motion across it leaves as it is. No history: what holds is seen
/// at the pose itself.
class BasinBoundary {
 public:
  /// Empties the boundary; its centres are a point of each body, in the body's axes at the frame's centre.
  void begin(BoundaryPool& pool, const Eigen::Vector3d& centre_a, const Eigen::Vector3d& centre_b);
  void clear(BoundaryPool& pool);

  /// @param level the distance (m) over the element at this pose
  /// @return false without memory
  bool add(BoundaryPool& pool, const PairFrame& frame, const BoundaryElement& element, double level,
           WorkLimit& limit);

  /// Moves the elements over which the distance is below `level` (m) from the boundary to `pool.crossed`.
  /// @return elements measured
  std::uint32_t takeCrossed(BoundaryPool& pool, const PairFrame& frame, double level);

  std::size_t size(const BoundaryPool& pool) const;

 private:
  /// Elements measured at one pose, seen from the axes of one body while the other one moves, whose part of
  /// each lies within the radius of its centre.
  struct Batch {
    Side fixed_in = Side::A;
    bool directed = false;
    Eigen::Matrix3d rotation;  ///< of the frame's frame, at the pose
    Eigen::Vector3d offset;
    float largest = 0.0F;  ///< radius
    std::uint32_t first = BoundaryPool::kNone;
  };
  static constexpr std::uint32_t kMostBatches = 8;
  class Bound;
  struct Radii;

  /// Returns the batch of this pose; there must be room for one more.
  Batch& batchAt(const PairFrame& frame, Side fixed_in, bool directed);
  /// Returns the place for another element, or kNone without memory.
  static std::uint32_t placeIn(BoundaryPool& pool, Batch& batch, WorkLimit& limit);
  static BoundaryPool::Entry takeFrom(BoundaryPool::Chunk& chunk, std::uint32_t k);
  /// @return false without memory
  static bool put(BoundaryPool& pool, Batch& batch, const BoundaryPool::Entry& entry, WorkLimit& limit);
  std::uint32_t look(BoundaryPool& pool, const PairFrame& frame, Batch& batch, double level) const;
  void rebase(BoundaryPool& pool, const PairFrame& frame);

  std::array<Eigen::Vector3d, 2> centres_;
  std::array<Batch, kMostBatches> batches_;
  std::uint32_t used_ = 0;  ///< batches
};

}  // namespace concave_distance::detail
