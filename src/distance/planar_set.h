#pragma once

#include <Eigen/Core>
#include <vector>

/// Points, segments and convex polygons in a plane, as lists of their corners.
namespace concave_distance::detail {

using PlanarPoints = std::vector<Eigen::Vector2d>;

/// The point of the segment (from, to) that is nearest to `point`.
Eigen::Vector2d nearestOnSegment(const Eigen::Vector2d& point, const Eigen::Vector2d& from,
                                 const Eigen::Vector2d& to);

/// Up to three corners: a triangle of either turn, a segment, a point.
struct PlanarFeature {
  Eigen::Vector2d corners[3];
  std::size_t count = 0;
};

/// Moves corners of `feature` that lie within `reach` of an edge or corner of `other` onto it.
void snapOnto(const PlanarFeature& other, double reach, PlanarFeature& feature);

/// The part of `feature` in `other`, `slack` more on all sides, into `polygon` (a buffer, as `scratch`).
void intersect(const PlanarFeature& feature, const PlanarFeature& other, double slack, PlanarPoints& polygon,
               PlanarPoints& scratch);

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
