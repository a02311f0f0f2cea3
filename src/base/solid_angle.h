#pragma once

#include <Eigen/Geometry>
#include <cmath>

namespace concave_distance {

/// Returns the solid angle of a triangle seen from the origin, signed: steradians (van Oosterom and Strackee
/// 1983).
inline double solidAngle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double l = a.norm();
  const double m = b.norm();
  const double n = c.norm();
  return 2.0 * std::atan2(a.dot(b.cross(c)), l * m * n + a.dot(b) * n + b.dot(c) * l + c.dot(a) * m);
}

}  // namespace concave_distance
