#pragma once

namespace concave_distance {

/// How far the norm of a quaternion, or a rotation matrix from an orthonormal one, may be off in input; a
/// smaller difference is normalised away.
inline constexpr double kUnitTolerance = 1e-3;

}  // namespace concave_distance
