#pragma once

namespace concave_distance {

/// Metres: the largest coordinate that meshes and the translations of poses may have. The search compares
/// squared distances in single precision, whose range ends at 3.4e38 (doc/numerics.md).
inline constexpr double kLargestCoordinate = 1e18;

}  // namespace concave_distance
