#pragma once

#include <limits>

namespace concave_distance {

inline constexpr double kPi = 3.14159265358979323846;

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Largest coordinate of meshes and of translations of poses, metres. The search compares squared distances
/// in single precision, whose range ends at 3.4e38 (doc/numerics.md).
inline constexpr double kLargestCoordinate = 1e18;

/// The norm of a quaternion, and a rotation matrix, may be off by this much in input; a smaller difference is
/// normalised away.
inline constexpr double kUnitTolerance = 1e-3;

}  // namespace concave_distance
