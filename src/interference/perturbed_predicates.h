#pragma once

#include <array>

#include "base/exact_orientation.h"
#include "base/side.h"

namespace concave_distance::detail {

inline constexpr Side other(Side side) {
  return side == Side::A ? Side::B : Side::A;
}
inline constexpr std::size_t at(Side side) {
  return static_cast<std::size_t>(side);
}

using Corners = std::array<const Eigen::Vector3d*, 3>;

/// The predicates of two bodies, B moved by an infinitesimal (simulation of
/// simplicity, Edelsbrunner and Muecke 1990): a vertex of one never lies on a plane of the other, nor an edge
/// on an edge, so that every crossing is an edge through the inside of a triangle and all agree on it.
class PerturbedPredicates {
 public:
  explicit PerturbedPredicates(const Motion& motion_of_b)
      : of_b_(motion_of_b), of_a_(reversed(motion_of_b)) {}
  /// Returns whether an exact coincidence was met, so that the motion may have mattered.
  bool tied() const { return tied_; }

  /// 1 where `point`, of the body `body`, lies above the other body's triangle, else -1; 0 for a triangle
  /// without area. `on_plane` says whether it lies on the plane but for the motion.
  int side(const Corners& triangle, Side body, const Eigen::Vector3d& point, bool& on_plane) {
    const int sign = orientationSign(*triangle[0], *triangle[1], *triangle[2], point);
    on_plane = sign == 0;
    if (sign != 0) return sign;
    tied_ = true;
    return signAlong(motionOf(body), *triangle[0], *triangle[1], *triangle[0], *triangle[2]);
  }

  int side(const Corners& triangle, Side body, const Eigen::Vector3d& point) {
    bool on_plane = false;
    return side(triangle, body, point, on_plane);
  }

  /// Returns how the edge (p, q) of A and the edge (r, s) of B pass each other: the sign of the determinant
  /// of the four. Neither may run parallel to a plane through the other, which is asked about only where one
  /// crosses the plane of a triangle with the other.
  int passing(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r,
              const Eigen::Vector3d& s) {
    const int sign = orientationSign(p, q, r, s);
    if (sign != 0) return sign;
    tied_ = true;
    // Moving r and s by e changes the determinant by ((s - r) x (q - p)) . e.
    return signAlong(of_b_, r, s, p, q);
  }

  /// Which of two planes of the other body the segment (p, q) of the body `body` meets
  /// first; see planeOrder.
  int order(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const PlaneOnSegment& first,
            const PlaneOnSegment& second, Side body) {
    return planeOrder(p, q, first, second, motionOf(body));
  }

 private:
  const Motion& motionOf(Side body) const { return body == Side::B ? of_b_ : of_a_; }

  Motion of_b_;
  Motion of_a_;  ///< relative to B
  bool tied_ = false;
};

}  // namespace concave_distance::detail
