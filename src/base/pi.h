#pragma once

namespace concave_distance {

inline constexpr double kPi = 3.14159265358979323846;

}  // namespace concave_distance
