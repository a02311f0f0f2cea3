#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

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

  /// Returns an empty group that precedes `next`.
  std::uint32_t take(std::uint32_t next);
  /// Frees the group and all after it.
  void release(std::uint32_t first);
  Chunk& operator[](std::uint32_t chunk) { return (*blocks_[chunk / kBlockSize])[chunk % kBlockSize]; }
  const Chunk& operator[](std::uint32_t chunk) const {
    return (*blocks_[chunk / kBlockSize])[chunk % kBlockSize];
  }

  void clear();

  // Results of the last BasinBoundary::takeCrossed().
  std::vector<Directed> anew;
  std::vector<BoundaryElement> crossed;
  bool has_unmeasured = false;

 private:
  static constexpr std::uint32_t kBlockSize = 64;
  using Block = std::array<Chunk, kBlockSize>;

  std::vector<std::unique_ptr<Block>> blocks_;  ///< the boundary of a large basin would be slow to copy
  std::uint32_t chunk_count_ = 0;
  std::uint32_t free_ = kNone;
};

}  // namespace concave_distance::detail
