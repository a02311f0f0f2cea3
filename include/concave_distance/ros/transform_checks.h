#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <ros/time.h>

#include <optional>
#include <string>

namespace concave_distance {

/// Why a transform cannot be used, and what whoever sends it can do.
struct TransformProblem {
  std::string what;
  std::string remedy;
};

struct TransformLimits {
  double cache = 10.0;            ///< s, of transforms kept
  double future_tolerance = 1.0;  ///< s, that a stamp may lie ahead of the clock
};

/// Looks at one transform alone: frame ids (without a leading slash), translation, rotation and, of one that
/// moves, the stamp.
/// @param fixed it came on /tf_static: its stamp means nothing
/// @param now zero: simulated time that has not begun
std::optional<TransformProblem> findTransformProblem(const geometry_msgs::TransformStamped& transform,
                                                     bool fixed, ros::Time now,
                                                     const TransformLimits& limits);

}  // namespace concave_distance
