#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>

namespace concave_distance::detail {

using PlaneTriangle = std::array<Eigen::Vector2d, 3>;

inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

struct Height {
  double value;        ///< negative outside
  std::uint32_t edge;  ///< from this corner to the next one
};

/// The least distance of a point from the lines of a counter-clockwise triangle's edges.
inline Height leastHeight(const PlaneTriangle& corners, const Eigen::Vector2d& point) {
  Height least{std::numeric_limits<double>::infinity(), 0};
  for (std::uint32_t k = 0; k < 3; ++k) {
    const Eigen::Vector2d along = (corners[(k + 1) % 3] - corners[k]).normalized();
    const double height = cross(along, point - corners[k]);
    if (height < least.value) {
      least = {height, k};
    }
  }
  return least;
}

inline double distanceToSegment(const Eigen::Vector2d& point, const Eigen::Vector2d& a,
                                const Eigen::Vector2d& b) {
  const double s = std::clamp((point - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (point - (a + s * (b - a))).norm();
}

}  // namespace concave_distance::detail
