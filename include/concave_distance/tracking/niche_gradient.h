#pragma once

#include "concave_distance/contact/contact_linearisation.h"
#include "concave_distance/tracking/pair_solution.h"

namespace concave_distance {

/// Says how a distance changes as its bodies move, m/s: by_a.dot(twist of A) + by_b.dot(twist of B). A twist
/// is the velocity of the body's point at a reference point, then the angular velocity (m/s, rad/s).
struct DistanceGradient {
  Vector6d by_a = Vector6d::Constant(kNotComputed);
  Vector6d by_b = Vector6d::Constant(kNotComputed);
};

/// The gradient of a distance, or signed distance, whose closest points are these. At a local minimum sliding
/// the points along the surfaces changes nothing to first order, so that only the velocities of the two
/// material points count (Danskin's theorem); where a niche changes its features it holds for one side.
/// @param normal unit vector from A's point to B's @param reference the reference point of both twists
inline DistanceGradient gradientOf(const Eigen::Vector3d& normal, const Eigen::Vector3d& point_a,
                                   const Eigen::Vector3d& point_b, const Eigen::Vector3d& reference) {
  return {-wrenchRow(normal, point_a - reference), wrenchRow(normal, point_b - reference)};
}

/// The gradient of a niche's distance, all in A's frame, for twists about A's origin.
inline DistanceGradient gradientOf(const TrackedNiche& niche) {
  return gradientOf(niche.normal_in_a, niche.point_a_in_a, niche.point_b_in_a, Eigen::Vector3d::Zero());
}

}  // namespace concave_distance
