#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <vector>

#include "concave_distance/kinematics/clearance.h"
#include "motion_curve.h"

namespace concave_distance::detail {

/// Checks the times of waypoints, or numbers them where there are none.
/// @param are_equal says whether a waypoint is the one before it: then both may have one time
/// @throws Error for no waypoint, another number of times, and times that are not finite or do not ascend
std::vector<double> requireTimes(const std::vector<double>& times, std::size_t count,
                                 const std::function<bool(std::size_t)>& are_equal);

/// Checks the numbers of a motion of joints, and returns the times of its waypoints. @throws Error
std::vector<double> requireWaypoints(const JointMotion& motion);

/// Returns the curve of a column of a motion whose numbers are checked.
MotionCurve curveOf(const JointMotion& motion, const std::vector<double>& times, std::size_t column);

}  // namespace concave_distance::detail
