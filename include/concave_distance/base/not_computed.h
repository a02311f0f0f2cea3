#pragma once

#include <limits>

namespace concave_distance {

/// Every number that was not computed is this NaN, never 0.
inline constexpr double kNotComputed = std::numeric_limits<double>::quiet_NaN();

}  // namespace concave_distance
