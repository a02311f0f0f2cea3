#pragma once

namespace concave_distance {

/// The norm of a quaternion, and a rotation matrix, may be off by this much in input; a smaller difference is
/// normalised away.
inline constexpr double kUnitTolerance = 1e-3;

}  // namespace concave_distance
