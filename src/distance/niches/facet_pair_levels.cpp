#include "facet_pair_levels.h"

#include <Eigen/Geometry>
#include <limits>

#include "distance/kernels/prepared_triangle.h"

namespace concave_distance::detail {
namespace {

using Eigen::Vector3d;
/// Four edges or corners at once; of a triangle the fourth is the first again.
using Lanes = Eigen::Array<double, 4, 1>;

struct VectorLanes {
  Lanes x;
  Lanes y;
  Lanes z;
};

VectorLanes lanesOf(const std::array<Vector3d, 4>& v) {
  return {{v[0].x(), v[1].x(), v[2].x(), v[3].x()},
          {v[0].y(), v[1].y(), v[2].y(), v[3].y()},
          {v[0].z(), v[1].z(), v[2].z(), v[3].z()}};
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

/// A facet with what every kernel needs of it.
struct PreparedFacet {
  explicit PreparedFacet(const FacetPoints& points) : points(points), first(points.first()), triangle(first) {
    for (std::size_t k = 0; k < 4; ++k) {
      edges[k] = points.corners[nextOf(k)] - points.corners[k];
      inverse_squared_lengths[k] = inverseOrZero(edges[k].squaredNorm());
    }
  }
  static std::size_t nextOf(std::size_t k) { return (k + 1) & 3U; }

  double size() const { return triangle.size() + edges[2].squaredNorm() + edges[3].squaredNorm(); }

  const FacetPoints& points;
  TrianglePoints first;
  PreparedTriangle triangle;  ///< the first
  std::array<Vector3d, 4> edges;
  std::array<double, 4> inverse_squared_lengths;
};

/// Squared distances of four points to the inside of a facet; infinite for those not over it.
Lanes pointsToInside(const VectorLanes& points, const PreparedFacet& facet) {
  const FaceFrame face(facet.triangle);
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
  if (!facet.points.is_quad) {
    const Lanes inside = along.min(1.0 - along).min(up).min(next).min(1.0 - next - up);
    return (inside > 0.0).select(dot(left, left), infinite());
  }
  // In coordinates (next, up) the first triangle's corners are (0, 0), (1, 0) and (0, 1).
  std::array<Eigen::Vector2d, 4> corners;
  const std::size_t base = facet.triangle.longestEdge();
  corners[base] = {0.0, 0.0};
  corners[nextCorner(base)] = {1.0, 0.0};
  corners[previousCorner(base)] = {0.0, 1.0};
  const Vector3d last = facet.points.corners[3] - face.corner;
  const double last_along = last.dot(edge) * face.inverse_ee;
  const double last_up = (last - last_along * edge).dot(face.height) * face.inverse_hh;
  corners[3] = {last_along - last_up * face.side_along, last_up};
  Lanes inside = infinite();
  for (std::size_t k = 0; k < 4; ++k) {
    const Eigen::Vector2d& from = corners[k];
    const Eigen::Vector2d span = corners[PreparedFacet::nextOf(k)] - from;
    inside = inside.min(span.x() * (up - from.y()) - span.y() * (next - from.x()));
  }
  return (inside > 0.0).select(dot(left, left), infinite());
}

/// Each edge's own and what its two ends have over the other's inside.
void lower(std::array<double, 4>& edges, const Lanes& corners) {
  for (std::size_t k = 0; k < 4; ++k) {
    const auto here = static_cast<Eigen::Index>(k);
    const auto next = static_cast<Eigen::Index>(PreparedFacet::nextOf(k));
    edges[k] = std::min({edges[k], corners[here], corners[next]});
  }
}

/// One by one, for facets that cross, may cross or are out of range.
FacetPairLevels oneByOne(const FacetPoints& a, const FacetPoints& b) {
  const auto squared_distance = [](const Vector3d& from, const Vector3d& to, const FacetPoints& facet) {
    const TrianglePoints edge{from, to, to};
    const double first = triangleDistance(edge, facet.first()).squared_distance;
    return facet.is_quad ? std::min(first, triangleDistance(edge, facet.second()).squared_distance) : first;
  };
  FacetPairLevels levels{};
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t next = PreparedFacet::nextOf(k);
    levels.edges_of_a[k] = squared_distance(a.corners[k], a.corners[next], b);
    levels.edges_of_b[k] = squared_distance(b.corners[k], b.corners[next], a);
  }
  return levels;
}

/// Returns whether a's plane, b's or one across the line between their middles parts them by more than the
/// rounding of their distances.
bool certainlyApart(const PreparedFacet& a, const PreparedFacet& b) {
  const auto parts = [&](const Vector3d& d) {
    const auto along = [&](const FacetPoints& points) {
      const std::array<Vector3d, 4>& c = points.corners;
      return Lanes(d.dot(c[0]), d.dot(c[1]), d.dot(c[2]), d.dot(c[3]));
    };
    const Lanes of_a = along(a.points);
    const Lanes of_b = along(b.points);
    const double largest = std::max(of_a.abs().maxCoeff(), of_b.abs().maxCoeff());
    return std::max(of_b.minCoeff() - of_a.maxCoeff(), of_a.minCoeff() - of_b.maxCoeff()) > 1e-12 * largest;
  };
  const auto middle = [](const FacetPoints& points) -> Vector3d {
    return points.corners[0] + points.corners[1] + points.corners[2] + points.corners[3];
  };
  return parts(middle(b.points) - middle(a.points)) ||
         parts(a.triangle.edges[0].cross(a.triangle.edges[1])) ||
         parts(b.triangle.edges[0].cross(b.triangle.edges[1]));
}

}  // namespace

FacetPairLevels facetPairLevels(const FacetPoints& a, const FacetPoints& b) {
  const PreparedFacet side_a(a);
  const PreparedFacet side_b(b);
  const double size = side_a.size() + side_b.size() + (b.corners[0] - a.corners[0]).squaredNorm();
  if (!(size > kLeastSquare && size < kLargestSquare) || !certainlyApart(side_a, side_b)) {
    return oneByOne(a, b);
  }
  const VectorLanes corners_b = lanesOf(b.corners);
  const VectorLanes edges_b = lanesOf(side_b.edges);
  const Lanes inverses_b(side_b.inverse_squared_lengths[0], side_b.inverse_squared_lengths[1],
                         side_b.inverse_squared_lengths[2], side_b.inverse_squared_lengths[3]);
  FacetPairLevels levels{};
  levels.edges_of_a[3] = std::numeric_limits<double>::infinity();
  Lanes least_b = infinite();
  for (std::size_t k = 0; k < a.edgeCount(); ++k) {
    const Lanes squared = edgeToEdges(a.corners[k], side_a.edges[k], side_a.inverse_squared_lengths[k],
                                      corners_b, edges_b, inverses_b);
    levels.edges_of_a[k] = squared.minCoeff();
    least_b = least_b.min(squared);
  }
  for (std::size_t k = 0; k < 4; ++k) levels.edges_of_b[k] = least_b[static_cast<Eigen::Index>(k)];
  lower(levels.edges_of_a, pointsToInside(lanesOf(a.corners), side_b));
  lower(levels.edges_of_b, pointsToInside(corners_b, side_a));
  // A corner of b over a's inside has no edge of a's, but the edges of a are no closer than the pair.
  return levels;
}

}  // namespace concave_distance::detail
