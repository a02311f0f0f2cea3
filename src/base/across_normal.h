#pragma once

#include <Eigen/Core>

namespace concave_distance {

/// The part of a vector across a unit normal.
inline Eigen::Vector3d acrossNormal(const Eigen::Vector3d& normal, const Eigen::Vector3d& vector) {
  return vector - normal.dot(vector) * normal;
}

}  // namespace concave_distance
