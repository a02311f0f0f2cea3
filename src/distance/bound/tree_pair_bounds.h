#pragma once

#include "directional_support.h"
#include "hierarchy_access.h"
#include "nearest_triangles.h"

namespace concave_distance::detail {

/// Bounds how near what two boxes hold may come, one box of either body's tree, at one pose. Of a pair of
/// boxes one is kept and the other one is opened: its children are bounded against the kept one together.
class TreePairBounds {
 public:
  using Slot = BoundingVolumeHierarchy::Slot;

  TreePairBounds(const ProofFrame& frame, const NearestTriangles& nearest, CertificateWorkspace& workspace,
                 CertificateCost& cost);

  /// Says which box of a pair is to be opened: the larger one that is no leaf.
  bool opensB(Slot a, Slot b) const {
    if (isLeaf(a_.child(a))) return true;
    return !isLeaf(b_.child(b)) &&
           squaredSize(b_, b) * unit_b_ * unit_b_ >= squaredSize(a_, a) * unit_a_ * unit_a_;
  }

  /// Returns squared bounds (square metres) of a box against the children of a node of the other body.
  /// `directions`, if given, gets the directions that part them.
  Lanes squaredBounds(Slot kept, std::uint32_t opened, bool opens_b, LaneDirections* directions);

  /// Returns how far a node's children are from the kept box along given directions, metres.
  Lanes separationsAlong(const LaneDirections& directions, Slot kept, bool opens_b) const;

  /// Returns the child of a node that is nearest to the kept box. Where boxes overlap or tie, the nearer
  /// centre decides.
  std::uint32_t nearestChild(Slot kept, std::uint32_t opened, bool opens_b);

  /// Returns how far what two boxes hold is apart along the direction between the nearest points, metres. It
  /// looks below the boxes.
  double separationAlongWitnesses(Slot a, Slot b) {
    if (direction_count_ != nearest_.directionCount()) takeDirection();
    return offset_along_ - support_a_.of(a) - support_b_.of(b) - frame_.scale.slack;
  }

 private:
  void takeDirection();

  const BoundingVolumeHierarchy& a_;
  const BoundingVolumeHierarchy& b_;
  const ProofFrame& frame_;
  const NearestTriangles& nearest_;
  CertificateCost& cost_;
  const float unit_a_;  ///< reach of A relative to the scale
  const float unit_b_;
  const SinglePose single_a_from_b_;
  const SinglePose single_b_from_a_;
  DirectionalSupport support_a_;       ///< along the direction between the nearest points
  DirectionalSupport support_b_;       ///< against it
  std::uint32_t direction_count_ = 0;  ///< of the direction that the supports are along
  double offset_along_ = 0.0;          ///< metres, from A's origin to B's along it

  // Boxes are compared several times in a row.
  Slot compared_slot_a_ = BoundingVolumeHierarchy::kNoChild;
  Slot compared_slot_b_ = BoundingVolumeHierarchy::kNoChild;
  ComparedBox compared_a_;
  ComparedBox compared_b_;
};

}  // namespace concave_distance::detail
