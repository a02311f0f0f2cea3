#pragma once

#include <limits>

namespace concave_distance {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace concave_distance
