#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>

#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/tracking/pair_solution.h"

namespace concave_distance {

/// Holds two bodies as they are solved: each near the origin of its own frame (BodyMesh::recentred()), so
/// that all tolerances are relative to the bodies and the gap, wherever the bodies were modelled.
class RecentredPair {
 public:
  RecentredPair(const std::shared_ptr<const BodyMesh>& a, const std::shared_ptr<const BodyMesh>& b);

  const std::shared_ptr<const BodyMesh>& a() const { return a_; }
  const std::shared_ptr<const BodyMesh>& b() const { return b_; }
  /// Returns whether a body is not where it was modelled.
  bool isMoved() const { return is_moved_; }

  /// Returns the pose of the bodies as they are solved; nothing for one that is not rigid.
  std::optional<Eigen::Isometry3d> poseOf(const Eigen::Isometry3d& a_from_b) const;

  /// Returns how far B as it is solved may be off, for bodies that are near each other; metres. What is
  /// farther apart loses no more than the rounding of its distance besides.
  double poseError() const;

  /// Brings a solution for poseOf(a_from_b) into the frame that A was modelled in. The lower bound loses what
  /// the pose does: the rounding of its product with the origin of B.
  void moveBack(const Eigen::Isometry3d& a_from_b, PairSolution& solution) const;

 private:
  Eigen::Vector3d origin_a_;  ///< of a() in the frame that A was modelled in, metres
  Eigen::Vector3d origin_b_;
  std::shared_ptr<const BodyMesh> a_;
  std::shared_ptr<const BodyMesh> b_;
  bool is_moved_;
};

}  // namespace concave_distance
