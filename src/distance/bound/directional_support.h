#pragma once

#include "certificate.h"
#include "mesh/trees/bounding_volume_hierarchy.h"

namespace concave_distance::detail {

/// Bounds how far the triangles below each box reach along one direction, by descending one tree alone. A box
/// reaches beyond the surface it holds; near a witness point, where all of a convex neighbourhood lies behind
/// the witness's plane, that little is what keeps boxes of both bodies from being parted along the witness
/// direction. A few boxes of one tree do for all pairs they are in.
class DirectionalSupport {
 public:
  DirectionalSupport(const BoundingVolumeHierarchy& hierarchy, SupportCache& cache);

  /// Begins anew. `direction`: unit, body frame; `limit` (metres along it, from the hierarchy's origin): what
  /// reaches no farther need not be known more closely, and what certainly reaches farther neither.
  void setDirection(const Eigen::Vector3d& direction, double limit);

  /// Returns no less than the reach of any triangle below the slot, but for rounding; metres.
  double of(BoundingVolumeHierarchy::Slot slot);

 private:
  using Hierarchy = BoundingVolumeHierarchy;

  double refine(Hierarchy::Slot slot, double box_support);
  double mostOfChildren(std::uint32_t child);

  const Hierarchy& hierarchy_;
  SupportCache& cache_;
  Eigen::Vector3d direction_ = Eigen::Vector3d::Zero();
  double limit_ = 0.0;
};

}  // namespace concave_distance::detail
