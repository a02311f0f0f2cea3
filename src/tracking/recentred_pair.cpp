#include "recentred_pair.h"

#include <algorithm>
#include <cmath>

#include "distance/bound/certificate.h"
#include "rigid_pose.h"

namespace concave_distance {
namespace {

std::shared_ptr<const BodyMesh> nearItsOrigin(const std::shared_ptr<const BodyMesh>& body) {
  return body->recentred().mesh != nullptr ? body->recentred().mesh : body;
}

}  // namespace

RecentredPair::RecentredPair(const std::shared_ptr<const BodyMesh>& a,
                             const std::shared_ptr<const BodyMesh>& b)
    : origin_a_(a->recentred().origin),
      origin_b_(b->recentred().origin),
      a_(nearItsOrigin(a)),
      b_(nearItsOrigin(b)),
      is_moved_(a_ != a || b_ != b) {}

std::optional<Eigen::Isometry3d> RecentredPair::poseOf(const Eigen::Isometry3d& a_from_b) const {
  std::optional<Eigen::Isometry3d> pose = rigidPose(a_from_b);
  if (pose) pose->translation() = *pose * origin_b_ - origin_a_;
  return pose;
}

double RecentredPair::poseError() const {
  // The translation of bodies that are near each other is no longer than both origins: each coordinate loses
  // at most 6 units of rounding of them, and as much again where the pose is made rigid.
  constexpr double kRounding = 0x1.0p-49;
  return is_moved_ ? kRounding * (origin_a_.norm() + origin_b_.norm()) : 0.0;
}

void RecentredPair::moveBack(const Eigen::Isometry3d& a_from_b, PairSolution& solution) const {
  solution.a_from_b = a_from_b;
  solution.point_a_in_a += origin_a_;
  solution.point_b_in_a += origin_a_;
  for (TrackedNiche& niche : solution.niches) {
    niche.point_a_in_a += origin_a_;
    niche.point_b_in_a += origin_a_;
    niche.witness.point_a_in_a += origin_a_;
    niche.witness.point_b_in_a += origin_a_;
    niche.signed_place.point_a_in_a += origin_a_;
    niche.signed_place.point_b_in_a += origin_a_;
    niche.signed_place.pivot_in_a += origin_a_;
  }
  const double pose_error =
      kProofError * kPoseShare * (origin_a_.norm() + origin_b_.norm() + a_from_b.translation().norm());
  if (solution.lower_bound > 0.0) {
    solution.lower_bound = std::max(0.0, std::nextafter(solution.lower_bound - pose_error, 0.0));
  }
}

}  // namespace concave_distance
