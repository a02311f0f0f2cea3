#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "normal_cone_tree.h"

namespace concave_distance::detail {

inline constexpr double kConeSlack = 1e-9;  ///< radians that every cone of a feature is widened by

/// Returns the radians by which rounding may have turned a triangle's normal: 1e-14 times its longest edge
/// over the height on it. Infinite without an area.
double normalError(const SurfaceMesh& mesh, TriangleIndex triangle);

/// Returns the cap around `axis` (unit) with an angle, radians, widened by the slack.
DirectionCap capOfAngle(const Eigen::Vector3d& axis, double angle);

/// Returns a cap that holds both.
DirectionCap capAround(const DirectionCap& l, const DirectionCap& r);

/// Holds the directions u with w . u <= slack for a list of vectors w: a convex cone, kept as what is left of
/// the six faces of a cube around the origin, each clipped as a polygon.
class ConeClipper {
 public:
  void reset();  ///< every direction
  /// Keeps the directions with w . u <= slack; |w| = 1. A face of more than 256 corners stays as it is: what
  /// is left holds the cone all the same.
  void clip(const Eigen::Vector3d& w, double slack);
  /// Returns the cap around what is left on the side with normal . u >= -kConeSlack; empty when nothing is. A
  /// zero normal leaves nothing out.
  std::optional<DirectionCap> capOnSide(const Eigen::Vector3d& normal);

 private:
  using Polygon = std::vector<Eigen::Vector3d>;
  void clipPolygon(Polygon& polygon, const Eigen::Vector3d& w, double slack);
  std::array<Polygon, 6> faces_;
  Polygon clipped_;
  Polygon side_;
  Polygon corners_;
};

}  // namespace concave_distance::detail
