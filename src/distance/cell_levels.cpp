#include "cell_levels.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "prepared_triangle.h"

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;
/// Three edges or corners at once; the fourth lane repeats the first.
using Lanes = Eigen::Array<double, 4, 1>;

struct VectorLanes {
  Lanes x;
  Lanes y;
  Lanes z;
};

VectorLanes lanesOf(const Vector3d& v0, const Vector3d& v1, const Vector3d& v2) {
  return {
      {v0.x(), v1.x(), v2.x(), v0.x()}, {v0.y(), v1.y(), v2.y(), v0.y()}, {v0.z(), v1.z(), v2.z(), v0.z()}};
}

VectorLanes operator-(const VectorLanes& l, const Vector3d& r) {
  return {l.x - r.x(), l.y - r.y(), l.z - r.z()};
}

Lanes dot(const VectorLanes& l, const VectorLanes& r) {
  return l.x * r.x + l.y * r.y + l.z * r.z;
}

Lanes dot(const VectorLanes& l, const Vector3d& r) {
  return l.x * r.x() + l.y * r.y() + l.z * r.z();
}

VectorLanes cross(const VectorLanes& l, const VectorLanes& r) {
  return {l.y * r.z - l.z * r.y, l.z * r.x - l.x * r.z, l.x * r.y - l.y * r.x};
}

Lanes infinite() {
  return Lanes::Constant(std::numeric_limits<double>::infinity());
}

Lanes clampToUnit(const Lanes& x) {
  return x.max(0.0).min(1.0);
}

/// Squared distances of one edge of a to all edges of b; the formula is that of triangle_distance.cpp, but
/// that the edge's own parameter is chosen anew at the end for every lane.
Lanes edgeToEdges(const Vector3d& from, const Vector3d& u, double inverse_uu, const VectorLanes& corners,
                  const VectorLanes& v, const Lanes& inverse_vv) {
  const VectorLanes w = corners - from;
  const VectorLanes n = {u.y() * v.z - u.z() * v.y, u.z() * v.x - u.x() * v.z, u.x() * v.y - u.y() * v.x};
  const Lanes nn = dot(n, n);
  // Parallel edges may start anywhere.
  const Lanes s0 = clampToUnit(dot(cross(w, v), n) / nn.max(std::numeric_limits<double>::min()));
  const Lanes t = clampToUnit((dot(v, u) * s0 - dot(v, w)) * inverse_vv);
  const VectorLanes to = {w.x + t * v.x, w.y + t * v.y, w.z + t * v.z};
  const Lanes s = clampToUnit(dot(to, u) * inverse_uu);
  const VectorLanes between = {to.x - s * u.x(), to.y - s * u.y(), to.z - s * u.z()};
  return dot(between, between);
}

/// Squared distances of three points to the inside of a triangle; infinite for those not over it.
Lanes pointsToInside(const VectorLanes& points, const PreparedTriangle& triangle) {
  const FaceFrame face(triangle);
  if (face.flat()) return infinite();
  const Vector3d& edge = face.edge;
  const Vector3d& side = face.side;
  const VectorLanes w = points - face.corner;
  const Lanes along = dot(w, edge) * face.inverse_ee;
  const VectorLanes off = {w.x - along * edge.x(), w.y - along * edge.y(), w.z - along * edge.z()};
  const Lanes up = dot(off, face.height) * face.inverse_hh;
  const Lanes next = along - up * face.side_along;
  const VectorLanes left = {w.x - next * edge.x() - up * side.x(), w.y - next * edge.y() - up * side.y(),
                            w.z - next * edge.z() - up * side.z()};
  const Lanes inside = along.min(1.0 - along).min(up).min(next).min(1.0 - next - up);
  return (inside > 0.0).select(dot(left, left), infinite());
}

/// Each edge's own and what its two ends have over the other's inside.
void lower(std::array<double, 3>& edges, const Lanes& corners) {
  for (std::size_t k = 0; k < 3; ++k) {
    const auto here = static_cast<Eigen::Index>(k);
    const auto next = static_cast<Eigen::Index>(nextCorner(k));
    edges[k] = std::min({edges[k], corners[here], corners[next]});
  }
}

/// One by one, for triangles that cross, may cross or are out of range.
CellLevels oneByOne(const TrianglePoints& a, const TrianglePoints& b) {
  CellLevels levels{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = nextCorner(k);
    levels.edges_of_a[k] = triangleDistance({a[k], a[next], a[next]}, b).squared_distance;
    levels.edges_of_b[k] = triangleDistance(a, {b[k], b[next], b[next]}).squared_distance;
  }
  return levels;
}

/// Whether a's plane or b's, or a plane across the line between their middles, parts them by more than
/// rounding.
bool certainlyApart(const PreparedTriangle& a, const PreparedTriangle& b) {
  const auto parts = [&](const Vector3d& d) {
    const double a0 = d.dot(a.corners[0]);
    const double a1 = d.dot(a.corners[1]);
    const double a2 = d.dot(a.corners[2]);
    const double b0 = d.dot(b.corners[0]);
    const double b1 = d.dot(b.corners[1]);
    const double b2 = d.dot(b.corners[2]);
    const double most_a = std::max({a0, a1, a2});
    const double least_a = std::min({a0, a1, a2});
    const double most_b = std::max({b0, b1, b2});
    const double least_b = std::min({b0, b1, b2});
    const double largest =
        std::max({std::abs(most_a), std::abs(least_a), std::abs(most_b), std::abs(least_b)});
    return std::max(least_b - most_a, least_a - most_b) > 1e-12 * largest;
  };
  const Vector3d between =
      (b.corners[0] + b.corners[1] + b.corners[2]) - (a.corners[0] + a.corners[1] + a.corners[2]);
  return parts(between) || parts(a.edges[0].cross(a.edges[1])) || parts(b.edges[0].cross(b.edges[1]));
}

}  // namespace

CellLevels cellLevels(const TrianglePoints& a, const TrianglePoints& b) {
  const PreparedTriangle side_a(a);
  const PreparedTriangle side_b(b);
  const double size = side_a.size() + side_b.size() + (b[0] - a[0]).squaredNorm();
  if (!(size > kLeastSquare && size < kLargestSquare) || !certainlyApart(side_a, side_b)) {
    return oneByOne(a, b);
  }
  const VectorLanes corners_b = lanesOf(b[0], b[1], b[2]);
  const VectorLanes edges_b = lanesOf(side_b.edges[0], side_b.edges[1], side_b.edges[2]);
  const Lanes inverses_b(side_b.inverse_squared_lengths[0], side_b.inverse_squared_lengths[1],
                         side_b.inverse_squared_lengths[2], side_b.inverse_squared_lengths[0]);
  CellLevels levels{};
  Lanes least_b = infinite();
  for (std::size_t k = 0; k < 3; ++k) {
    const Lanes squared =
        edgeToEdges(a[k], side_a.edges[k], side_a.inverse_squared_lengths[k], corners_b, edges_b, inverses_b);
    levels.edges_of_a[k] = squared.minCoeff();
    least_b = least_b.min(squared);
  }
  for (std::size_t k = 0; k < 3; ++k) levels.edges_of_b[k] = least_b[static_cast<Eigen::Index>(k)];
  const Lanes corners_over_b = pointsToInside(lanesOf(a[0], a[1], a[2]), side_b);
  const Lanes corners_over_a = pointsToInside(corners_b, side_a);
  lower(levels.edges_of_a, corners_over_b);
  lower(levels.edges_of_b, corners_over_a);
  // What a corner of b has over a's inside is no edge of a's, but the edges of a are no closer than the pair.
  return levels;
}

}  // namespace concave_distance::detail
