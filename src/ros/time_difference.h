#pragma once

#include <ros/time.h>

#include <cstdint>

namespace concave_distance {

/// Seconds from `earlier` to `later`; negative when `later` is earlier. Works for any two times, while
/// subtracting ros::Time throws beyond 2^31 s.
inline double secondsBetween(const ros::Time& earlier, const ros::Time& later) {
  const auto nanoseconds = [](const ros::Time& time) { return static_cast<std::int64_t>(time.toNSec()); };
  return 1e-9 * static_cast<double>(nanoseconds(later) - nanoseconds(earlier));
}

}  // namespace concave_distance
