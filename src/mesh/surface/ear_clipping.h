#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace concave_distance::detail {

/// Cuts a simple counter-clockwise polygon into triangles of its corners, well shaped ones first. Corners in
/// line with their neighbours are allowed. No triangle is flatter than `least_height`, and no diagonal comes
/// nearer to a third corner. Empty when no such cut is found. O(n (log n + r)) for r corners not convex.
/// @param allows_diagonal asked before two corners are joined, by their positions in the polygon
std::vector<std::array<std::uint32_t, 3>> clipEars(
    const std::vector<Eigen::Vector2d>& polygon, double least_height,
    const std::function<bool(std::uint32_t, std::uint32_t)>& allows_diagonal);

}  // namespace concave_distance::detail
