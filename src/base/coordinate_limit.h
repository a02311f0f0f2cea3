#pragma once

namespace concave_distance {

/// Largest coordinate of meshes and of translations of poses, metres. The search compares squared distances
/// in single precision, whose range ends at 3.4e38 (doc/numerics.md).
inline constexpr double kLargestCoordinate = 1e18;

}  // namespace concave_distance
