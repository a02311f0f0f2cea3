#pragma once

#include <string>

namespace concave_distance {

/// Returns why ROS time is zero, with the remedy; empty when it is not.
std::string missingClock();

}  // namespace concave_distance
