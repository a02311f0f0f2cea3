#pragma once

#include <string>

namespace concave_distance {

/// Why ROS time stands at zero, with the remedy; empty: it does not.
std::string missingClock();

}  // namespace concave_distance
