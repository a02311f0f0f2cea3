#include "pressure_triangles.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/triangle_measures.h"
#include "distance/bound/closest_point.h"
#include "mesh/surface/mesh_topology.h"
#include "mesh/surface/round_geometry.h"
#include "mesh/trees/triangle_tree.h"

namespace concave_distance {
namespace {

// Edges are at least this share of the longest facet's, also where the area asks for less:
// slivers have many per area.
constexpr double kLeastEdge = 1.0 / 64.0;
// Area of a triangle that was halved across its longest edge until that is short enough, over its square.
constexpr double kAreaOverEdge = 0.25;
// From a corner to the middle of its triangle: on the border itself the depth is 0, however steeply it grows.
constexpr double kInwards = 0.1;

using Corners = std::array<Eigen::Vector3d, 3>;

/// Halves a triangle across its longest edge until that is at most `edge` long.
template <typename Leaf>
void halve(const Corners& corners, double edge, const Leaf& leaf) {
  const std::size_t k = longestEdge(corners);
  if (!(squaredEdge(corners, k) > edge * edge)) {
    leaf(corners);
    return;
  }
  const Eigen::Vector3d& from = corners[k];
  const Eigen::Vector3d& to = corners[(k + 1) % 3];
  const Eigen::Vector3d& tip = corners[(k + 2) % 3];
  const Eigen::Vector3d cut = 0.5 * (from + to);
  halve({from, cut, tip}, edge, leaf);
  halve({cut, to, tip}, edge, leaf);
}

class Cutter {
 public:
  explicit Cutter(const PressedSurface& surface) : surface_(surface) {}

  bool isDrawn(const OverlapFacet& facet) const { return facet.of_b == surface_.of_b && !facet.is_negative; }

  std::size_t count(double edge) const {
    std::size_t number = 0;
    for (const OverlapFacet* facet = surface_.first; facet != surface_.last; ++facet) {
      if (!isDrawn(*facet)) continue;
      halve(facet->corners_in_a, edge, [&](const Corners&) { ++number; });
    }
    return number;
  }

  void cut(const OverlapFacet& facet, double edge, double lift, std::vector<PressureTriangle>& triangles) {
    // Into its body: out of the other one, whose surface is a depth away.
    const auto shifted = [&](const Eigen::Vector3d& point) {
      const double way = lift < 0.0 ? lift - wayOut(surface_.other_from_a * point).norm() : lift;
      return Eigen::Vector3d(point + way * facet.normal_in_a);
    };
    halve(facet.corners_in_a, edge, [&](const Corners& part) {
      const Eigen::Vector3d middle = (part[0] + part[1] + part[2]) / 3.0;
      if (facet.may_leave && !isInside(middle)) return;
      PressureTriangle& triangle = triangles.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        triangle[k] = {shifted(part[k]), pressureAt(facet, part[k] + kInwards * (middle - part[k]))};
      }
      if (lift < 0.0) std::swap(triangle[1], triangle[2]);
    });
  }

 private:
  bool isInside(const Eigen::Vector3d& point_in_a) const {
    const BodyMesh& other = surface_.other;
    return containsPoint(other.tree(), other.surface(), other.topology().shell_is_closed,
                         other.topology().shell_of_triangle, surface_.other_from_a * point_in_a);
  }

  double pressureAt(const OverlapFacet& facet, const Eigen::Vector3d& point) {
    const Eigen::Vector3d push = facet.of_b ? Eigen::Vector3d(-facet.normal_in_a) : facet.normal_in_a;
    if (!surface_.field.carries(push) || (facet.may_leave && !isInside(point))) return 0.0;
    const Eigen::Vector3d way = wayOut(surface_.other_from_a * point);
    const double depth = way.norm();
    if (!(depth > 0.0)) return 0.0;
    const Eigen::Vector3d exit = surface_.other_from_a.linear().transpose() * way / depth;
    return depth * surface_.field.perDepth(surface_.field.approachRate(point, push, exit));
  }

  /// Returns the way to the other body's surface, its frame.
  Eigen::Vector3d wayOut(const Eigen::Vector3d& target) {
    if (const RoundShape* shape = surface_.other.shape()) {
      const Eigen::Vector3d in_shape = shape->body_from_shape.inverse(Eigen::Isometry) * target;
      const double depth = std::max(0.0, -detail::signedDistance(*shape, in_shape));
      return shape->body_from_shape.linear() * (depth * detail::outwardDirection(*shape, in_shape));
    }
    const SurfacePoint nearest = closestPoint(surface_.other, target, last_);
    last_ = nearest.triangle;
    return nearest.point - target;
  }

  const PressedSurface& surface_;
  TriangleIndex last_{0};  ///< nearest to the last point
};

}  // namespace

std::vector<PressureTriangle> pressureTriangles(const PressedSurface& surface, double lift,
                                                std::size_t most) {
  std::vector<PressureTriangle> triangles;
  Cutter cutter(surface);
  double area = 0.0;
  double longest = 0.0;
  std::size_t facets = 0;
  for (const OverlapFacet* facet = surface.first; facet != surface.last; ++facet) {
    if (!cutter.isDrawn(*facet)) continue;
    ++facets;
    area += triangleArea(facet->corners_in_a);
    longest =
        std::max(longest, std::sqrt(squaredEdge(facet->corners_in_a, longestEdge(facet->corners_in_a))));
  }
  if (facets == 0 || facets > most) return triangles;
  double edge = std::max(std::sqrt(area / (kAreaOverEdge * kPressureTriangles)), kLeastEdge * longest);
  while (edge < longest && cutter.count(edge) > most) edge *= 2.0;
  triangles.reserve(facets);
  for (const OverlapFacet* facet = surface.first; facet != surface.last; ++facet) {
    if (cutter.isDrawn(*facet)) cutter.cut(*facet, edge, lift, triangles);
  }
  return triangles;
}

}  // namespace concave_distance
