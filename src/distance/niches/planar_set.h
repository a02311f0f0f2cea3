#pragma once

#include <Eigen/Core>
#include <vector>

/// Points, segments and convex polygons in a plane, as lists of their corners.
namespace concave_distance::detail {

using PlanarPoints = std::vector<Eigen::Vector2d>;

/// Up to three corners: a triangle of either turn, a segment, a point.
struct PlanarFeature {
  Eigen::Vector2d corners[3];
  std::size_t count = 0;
};

/// Appends what two features have in common, as corners (unordered, some twice): corners of either within
/// `reach` of the other, and crossings of their edges. Borders that run side by side within `reach` are thus
/// common as far as they do, while a crossing stays a point however far the reach.
void appendOverlap(const PlanarFeature& a, const PlanarFeature& b, double reach, PlanarPoints& points);

/// Convex hull, counter-clockwise, without repeated or collinear corners; sorts `points`.
void convexHull(PlanarPoints& points, PlanarPoints& hull);

/// Largest distance of two corners.
double diameterOf(const PlanarPoints& hull);

/// Least width of the strip, parallel to the longest diagonal, that holds all corners.
double widthOf(const PlanarPoints& hull);

/// Centre of the smallest circle around all corners. O(n) expected, O(n^3) at worst.
Eigen::Vector2d centreOfEnclosingCircle(const PlanarPoints& hull);

/// The point of the convex polygon `corners` (also a segment or a point, corners in order) nearest to
/// `point`.
Eigen::Vector2d nearestIn(const Eigen::Vector2d* corners, std::size_t count, const Eigen::Vector2d& point);

}  // namespace concave_distance::detail
