#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

namespace concave_distance {

/// Squared length of a triangle's edge from corner k to corner (k + 1) % 3.
inline double squaredEdge(const std::array<Eigen::Vector3d, 3>& corners, std::size_t k) {
  return (corners[k] - corners[(k + 1) % 3]).squaredNorm();
}

/// The longest edge of a triangle; the first of equally long ones.
inline std::size_t longestEdge(const std::array<Eigen::Vector3d, 3>& corners) {
  const std::size_t k = squaredEdge(corners, 1) > squaredEdge(corners, 0) ? 1 : 0;
  return squaredEdge(corners, 2) > squaredEdge(corners, k) ? 2 : k;
}

}  // namespace concave_distance
