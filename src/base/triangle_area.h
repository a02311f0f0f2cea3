#pragma once

#include <Eigen/Core>
#include <array>

namespace concave_distance {

inline double triangleArea(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return 0.5 * (b - a).cross(c - a).norm();
}

inline double triangleArea(const std::array<Eigen::Vector3d, 3>& corners) {
  return triangleArea(corners[0], corners[1], corners[2]);
}

}  // namespace concave_distance
