#pragma once

#include <Eigen/Geometry>

#include "concave_distance/contact/wrench.h"

namespace concave_distance {

/// Velocity of B relative to A from two poses of B in A's frame: the rotation between them about its axis,
/// and of B's origin the way between them. Right to second order of the angle in between, exact without one.
/// @param seconds from `before` to `after`; zero or less gives no velocity
RelativeTwist motionBetween(const Eigen::Isometry3d& before, const Eigen::Isometry3d& after, double seconds);

}  // namespace concave_distance
