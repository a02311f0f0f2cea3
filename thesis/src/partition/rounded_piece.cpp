#include <CGAL/Projection_traits_xy_3.h>
#include <CGAL/Projection_traits_xz_3.h>
#include <CGAL/Projection_traits_yz_3.h>
#include <CGAL/convex_hull_2.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "exact_solid.h"

namespace concave_distance::detail {
namespace {

/// A facet of the exact polyhedron: its corners, counter-clockwise seen from outside, and its direction.
struct ExactFacet {
  std::vector<ExactPoint> corners;
  Eigen::Vector3d outward;
};

/// The corners of the convex hull of points in one plane, counter-clockwise against `outward`.
std::vector<ExactPoint> outlineOf(const std::vector<ExactPoint>& points,
                                  const ExactKernel::Vector_3& outward) {
  const Eigen::Vector3d size(std::abs(CGAL::to_double(outward.x())), std::abs(CGAL::to_double(outward.y())),
                             std::abs(CGAL::to_double(outward.z())));
  Eigen::Index axis = 0;
  size.maxCoeff(&axis);
  std::vector<ExactPoint> outline;
  bool positive = false;
  if (axis == 0) {
    CGAL::convex_hull_2(points.begin(), points.end(), std::back_inserter(outline),
                        CGAL::Projection_traits_yz_3<ExactKernel>());
    positive = CGAL::is_positive(outward.x());
  } else if (axis == 1) {
    // (x, z) is seen from -y.
    CGAL::convex_hull_2(points.begin(), points.end(), std::back_inserter(outline),
                        CGAL::Projection_traits_xz_3<ExactKernel>());
    positive = CGAL::is_negative(outward.y());
  } else {
    CGAL::convex_hull_2(points.begin(), points.end(), std::back_inserter(outline),
                        CGAL::Projection_traits_xy_3<ExactKernel>());
    positive = CGAL::is_positive(outward.z());
  }
  if (!positive) std::reverse(outline.begin(), outline.end());
  return outline;
}

/// A direction as doubles have it best: scaled first, so that tiny facets do not underflow.
Eigen::Vector3d roundedDirection(const ExactKernel::Vector_3& exact) {
  const auto size = CGAL::abs(exact.x()) + CGAL::abs(exact.y()) + CGAL::abs(exact.z());
  const auto component = [&size](const auto& value) {
    return CGAL::to_double(CGAL::exact(ExactKernel::FT(value / size)));
  };
  return {component(exact.x()), component(exact.y()), component(exact.z())};
}

std::vector<ExactFacet> facetsOf(const ExactPolyhedron& polyhedron) {
  std::vector<ExactPoint> points(polyhedron.points_begin(), polyhedron.points_end());
  std::vector<ExactKernel::Plane_3> planes;
  std::vector<ExactFacet> facets;
  for (auto facet = polyhedron.facets_begin(); facet != polyhedron.facets_end(); ++facet) {
    const auto edge = facet->halfedge();
    const ExactPoint& p = edge->vertex()->point();
    const ExactPoint& q = edge->next()->vertex()->point();
    // Three corners of one line span no plane: the first corner that is off the line does.
    auto third = edge->next()->next();
    while (third != edge && CGAL::collinear(p, q, third->vertex()->point())) third = third->next();
    if (third == edge) continue;
    const ExactPoint& r = third->vertex()->point();
    const bool known = std::any_of(planes.begin(), planes.end(), [&](const ExactKernel::Plane_3& plane) {
      return plane.has_on(p) && plane.has_on(q) && plane.has_on(r);
    });
    if (known) continue;
    planes.emplace_back(p, q, r);
    const ExactKernel::Vector_3 outward = CGAL::cross_product(q - p, r - p);
    std::vector<ExactPoint> on_plane;
    std::copy_if(points.begin(), points.end(), std::back_inserter(on_plane),
                 [&](const ExactPoint& point) { return planes.back().has_on(point); });
    facets.push_back({outlineOf(on_plane, outward), roundedDirection(outward)});
  }
  return facets;
}

Eigen::Vector3d rounded(const ExactPoint& point) {
  const auto& exact = CGAL::exact(point);
  return {CGAL::to_double(exact.x()), CGAL::to_double(exact.y()), CGAL::to_double(exact.z())};
}

}  // namespace

bool roundedPiece(const ExactPolyhedron& polyhedron, const std::string& where, ConvexPiece& piece) {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::vector<std::uint32_t>> facets;
  std::vector<Eigen::Vector3d> outward;
  std::map<std::tuple<double, double, double>, std::uint32_t> number;
  for (const ExactFacet& exact : facetsOf(polyhedron)) {
    std::vector<std::uint32_t> facet;
    for (const ExactPoint& corner : exact.corners) {
      const Eigen::Vector3d v = rounded(corner);
      const auto entry =
          number.emplace(std::make_tuple(v.x(), v.y(), v.z()), static_cast<std::uint32_t>(vertices.size()));
      if (entry.second) vertices.push_back(v);
      const std::uint32_t index = entry.first->second;
      if (std::find(facet.begin(), facet.end(), index) == facet.end()) facet.push_back(index);
    }
    if (facet.size() < 3) continue;
    facets.push_back(std::move(facet));
    outward.push_back(exact.outward);
  }
  if (facets.size() < 4 || vertices.size() < 4) return false;
  piece = makeConvexPiece(std::move(vertices), std::move(facets), outward, where);
  return true;
}

}  // namespace concave_distance::detail
