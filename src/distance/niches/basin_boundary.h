#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "boundary_pool.h"
#include "concave_distance/base/work_limit.h"

namespace concave_distance::detail {

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
  void add(BoundaryPool& pool, const PairFrame& frame, const BoundaryElement& element, double level);

  /// Moves the elements over which the distance is below `level` (m) from the boundary to `pool.crossed`.
  /// After the limit, elements that have to be measured stay, and pool.has_unmeasured says so.
  /// @return elements measured
  std::uint32_t takeCrossed(BoundaryPool& pool, const PairFrame& frame, double level, WorkLimit& limit);

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
  /// Returns the place for another element.
  static std::uint32_t placeIn(BoundaryPool& pool, Batch& batch);
  static BoundaryPool::Entry takeFrom(BoundaryPool::Chunk& chunk, std::uint32_t k);
  static void put(BoundaryPool& pool, Batch& batch, const BoundaryPool::Entry& entry);
  std::uint32_t look(BoundaryPool& pool, const PairFrame& frame, Batch& batch, double level,
                     WorkLimit& limit) const;
  void rebase(BoundaryPool& pool, const PairFrame& frame);

  std::array<Eigen::Vector3d, 2> centres_;
  std::array<Batch, kMostBatches> batches_;
  std::uint32_t used_ = 0;  ///< batches
};

}  // namespace concave_distance::detail
