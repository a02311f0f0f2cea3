#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstddef>

namespace concave_distance {

inline double triangleArea(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return 0.5 * (b - a).cross(c - a).norm();
}

inline double triangleArea(const std::array<Eigen::Vector3d, 3>& corners) {
  return triangleArea(corners[0], corners[1], corners[2]);
}

/// Squared length of a triangle's edge from corner k to corner (k + 1) % 3.
inline double squaredEdge(const std::array<Eigen::Vector3d, 3>& corners, std::size_t k) {
  return (corners[k] - corners[(k + 1) % 3]).squaredNorm();
}

/// The longest edge of a triangle; the first of equally long ones.
inline std::size_t longestEdge(const std::array<Eigen::Vector3d, 3>& corners) {
  const std::size_t k = squaredEdge(corners, 1) > squaredEdge(corners, 0) ? 1 : 0;
  return squaredEdge(corners, 2) > squaredEdge(corners, k) ? 2 : k;
}

/// Returns the solid angle of a triangle seen from the origin, signed: steradians (van Oosterom and Strackee
/// 1983).
inline double solidAngle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double l = a.norm();
  const double m = b.norm();
  const double n = c.norm();
  return 2.0 * std::atan2(a.dot(b.cross(c)), l * m * n + a.dot(b) * n + b.dot(c) * l + c.dot(a) * m);
}

}  // namespace concave_distance
