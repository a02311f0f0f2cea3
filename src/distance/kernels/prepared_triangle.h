#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "triangle_distance.h"

namespace concave_distance::detail {

/// Sums of squares between which no product of coordinates over- or underflows harmfully.
inline constexpr double kLeastSquare = 1e-100;
inline constexpr double kLargestSquare = 1e60;

inline double inverseOrZero(double x) {
  return x > 0.0 ? 1.0 / x : 0.0;
}

/// Corners and edges of a triangle go round.
inline std::size_t nextCorner(std::size_t k) {
  return k == 2 ? 0 : k + 1;
}
inline std::size_t previousCorner(std::size_t k) {
  return k == 0 ? 2 : k - 1;
}

/// A triangle with what every kernel needs of it. The points must live as long.
struct PreparedTriangle {
  explicit PreparedTriangle(const TrianglePoints& points)
      : corners(points),
        edges{points[1] - points[0], points[2] - points[1], points[0] - points[2]},
        squared_lengths{edges[0].squaredNorm(), edges[1].squaredNorm(), edges[2].squaredNorm()},
        inverse_squared_lengths{inverseOrZero(squared_lengths[0]), inverseOrZero(squared_lengths[1]),
                                inverseOrZero(squared_lengths[2])} {}

  double size() const { return squared_lengths[0] + squared_lengths[1] + squared_lengths[2]; }

  std::size_t longestEdge() const {
    const std::size_t k = squared_lengths[0] >= squared_lengths[1] ? 0 : 1;
    return squared_lengths[2] > squared_lengths[k] ? 2 : k;
  }

  const TrianglePoints& corners;
  std::array<Eigen::Vector3d, 3> edges;  ///< from corner k to corner (k + 1) % 3
  std::array<double, 3> squared_lengths;
  std::array<double, 3> inverse_squared_lengths;  ///< 0 for an edge without length
};

/// The triangle's inside as seen from any point: coordinates along the longest edge (0 to 1) and along the
/// height on it (0 at the edge, 1 at the opposite corner). For a needle or cap whose height is phi times its
/// length the height's direction is wrong by eps / phi (eps the machine epsilon). It is only used on what the
/// longest edge leaves of a point, at most phi times the length plus the gap, so that the foot is wrong by
/// eps times the length plus eps / phi times the gap; the latter turns the gap and, the edges being nearer
/// than phi, lengthens it by no more than eps times the length.
struct FaceFrame {
  explicit FaceFrame(const PreparedTriangle& t) {
    const std::size_t base = t.longestEdge();
    corner = t.corners[base];
    edge = t.edges[base];
    inverse_ee = t.inverse_squared_lengths[base];
    side = -t.edges[previousCorner(base)];
    side_along = side.dot(edge) * inverse_ee;
    height = side - side_along * edge;
    inverse_hh = inverseOrZero(height.squaredNorm());
  }

  bool flat() const { return inverse_hh == 0.0; }

  /// Returns whether `point` projects inside, and where; the foot lies on the triangle whatever the rounding.
  bool isOver(const Eigen::Vector3d& point, Eigen::Vector3d& foot) const {
    const Eigen::Vector3d w = point - corner;
    const double along = w.dot(edge) * inverse_ee;
    if (!(along > 0.0 && along < 1.0)) return false;
    const double up = (w - along * edge).dot(height) * inverse_hh;
    const double weight_next = along - up * side_along;
    if (!(up > 0.0 && weight_next > 0.0 && weight_next + up < 1.0)) return false;
    foot = corner + (weight_next * edge + up * side);
    return true;
  }

  /// Metres by which `point` projects beyond an edge's line, the most of the three; negative inside.
  double distanceBeside(const Eigen::Vector3d& point, const PreparedTriangle& t) const {
    const Eigen::Vector3d w = point - corner;
    const double along = w.dot(edge) * inverse_ee;
    const double up = (w - along * edge).dot(height) * inverse_hh;
    const double weight_next = along - up * side_along;
    const std::size_t base = t.longestEdge();
    // A weight times twice the area over the length of the edge opposite to it.
    const double area = std::sqrt(t.squared_lengths[base] * height.squaredNorm());
    const auto beside = [&](double weight, std::size_t opposite_edge) {
      return -weight * area / std::sqrt(t.squared_lengths[opposite_edge]);
    };
    return std::max({beside(up, base), beside(weight_next, previousCorner(base)),
                     beside(1.0 - weight_next - up, nextCorner(base))});
  }

  Eigen::Vector3d corner;  ///< where the longest edge starts
  Eigen::Vector3d edge;    ///< the longest
  Eigen::Vector3d side;    ///< from there to the opposite corner
  Eigen::Vector3d height;  ///< the part of it across the edge
  double side_along;       ///< where the height stands on the edge
  double inverse_ee;
  double inverse_hh;  ///< 0 for a triangle without area
};

}  // namespace concave_distance::detail
