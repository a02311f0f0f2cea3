#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <ros/time.h>

#include <optional>
#include <string>

namespace concave_distance {

/// Why a transform cannot be used, and what its sender can do.
struct TransformProblem {
  std::string what;
  std::string remedy;
};

struct TransformLimits {
  double cache = 10.0;            ///< s, of transforms kept
  double future_tolerance = 1.0;  ///< s that a stamp may be ahead of the clock
};

/// Checks one transform by itself: frame ids (without a leading slash), translation, rotation and, for a
/// moving one, the stamp.
/// @param fixed it came on /tf_static: its stamp is ignored
/// @param now zero: simulated time has not begun
std::optional<TransformProblem> findTransformProblem(const geometry_msgs::TransformStamped& transform,
                                                     bool fixed, ros::Time now,
                                                     const TransformLimits& limits);

/// Checks a moving transform against the newest one of its frame, and who sent that.
std::optional<TransformProblem> findOrderProblem(ros::Time stamp, ros::Time newest, const std::string& sender,
                                                 const TransformLimits& limits);

}  // namespace concave_distance
