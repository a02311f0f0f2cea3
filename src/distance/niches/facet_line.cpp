#include "facet_line.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;

/// Twice the area over the square of the longest edge, below which the rounding of a normal counts.
constexpr double kThinnest = 1e-3;
/// So many tolerances from a facet's plane or edge rounding decides nothing, for facets less thin than that.
constexpr double kClear = 16.0;

}  // namespace

FacetPlane::FacetPlane(const FacetPoints& points) : points_(points) {
  const std::array<Vector3d, 4>& c = points.corners;
  normal_ = points.is_quad ? (c[2] - c[0]).cross(c[3] - c[1]) : (c[1] - c[0]).cross(c[2] - c[0]);
  double longest = 0.0;
  for (std::size_t k = 0; k < points.edgeCount(); ++k) longest = std::max(longest, edge(k).squaredNorm());
  const double length = normal_.norm();
  if (length > kThinnest * longest) {
    normal_ /= length;
  } else {
    normal_.setZero();
  }
}

Vector3d FacetPlane::edge(std::size_t k) const {
  return points_.corners[k + 1 == points_.edgeCount() ? 0 : k + 1] - points_.corners[k];
}

bool FacetPlane::areClearlyApart(const FacetPlane& a, const FacetPlane& b, double tolerance) {
  return a.isApartFrom(b.points_, tolerance) || b.isApartFrom(a.points_, tolerance);
}

bool FacetPlane::isApartFrom(const FacetPoints& other, double tolerance) const {
  double least = normal_.dot(other.corners[0] - points_.corners[0]);
  double most = least;
  for (std::size_t k = 1; k < other.edgeCount(); ++k) {
    const double height = normal_.dot(other.corners[k] - points_.corners[0]);
    least = std::min(least, height);
    most = std::max(most, height);
  }
  return least > kClear * tolerance || most < -kClear * tolerance;
}

bool FacetPlane::isMet(const Vector3d& start, const Vector3d& end, double tolerance, LinePart& part) const {
  const double clear = kClear * tolerance;
  const double from = normal_.dot(start - points_.corners[0]);
  const double to = normal_.dot(end - points_.corners[0]);
  if ((from > clear && to > clear) || (from < -clear && to < -clear)) return false;
  const bool runs_through = (from > clear && to < -clear) || (from < -clear && to > clear);
  if (!runs_through) return isMetByMeasure(start, end, tolerance, part);
  const double at = from / (from - to);
  const Vector3d point = start + at * (end - start);
  bool is_clear = true;
  for (std::size_t k = 0; k < points_.edgeCount(); ++k) {
    const Vector3d along = edge(k);
    const double inwards = normal_.dot(along.cross(point - points_.corners[k]));
    const double least = clear * along.norm();
    if (inwards < -least) return false;
    is_clear = is_clear && inwards > least;
  }
  if (!is_clear) return isMetByMeasure(start, end, tolerance, part);
  part = {at, at, true};
  return true;
}

bool FacetPlane::isMetByMeasure(const Vector3d& start, const Vector3d& end, double tolerance,
                                LinePart& part) const {
  const TrianglePoints line{start, end, end};
  TrianglePairDistance closest = triangleDistance(line, points_.first());
  if (points_.is_quad) {
    const TrianglePairDistance other = triangleDistance(line, points_.second());
    if (other.squared_distance < closest.squared_distance) closest = other;
  }
  if (closest.squared_distance > tolerance * tolerance) return false;
  const Vector3d along = end - start;
  const double squared_length = along.squaredNorm();
  const double at =
      squared_length > 0.0 ? std::clamp(along.dot(closest.point_a - start) / squared_length, 0.0, 1.0) : 0.0;
  part = {at, at, false};
  // The line is clipped to the plane's surroundings, then to those of each edge.
  double first = 0.0;
  double last = 1.0;
  const auto clip = [&](double height, double rise, double least) {
    if (rise > 0.0) first = std::max(first, (least - height) / rise);
    if (rise < 0.0) last = std::min(last, (least - height) / rise);
    if (rise == 0.0 && height < least) last = -1.0;
  };
  const double height = normal_.dot(start - points_.corners[0]);
  const double rise = normal_.dot(along);
  clip(height, rise, -tolerance);
  clip(-height, -rise, -tolerance);
  for (std::size_t k = 0; k < points_.edgeCount(); ++k) {
    const Vector3d inwards = normal_.cross(edge(k));
    clip(inwards.dot(start - points_.corners[k]), inwards.dot(along), -tolerance * edge(k).norm());
  }
  if (first <= last) part = {std::min(first, at), std::max(last, at), false};
  return true;
}

}  // namespace concave_distance::detail
