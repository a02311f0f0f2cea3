#include "concave_distance/distance/surface_walk.h"

#include <algorithm>

namespace concave_distance {
namespace {

bool isVertex(Feature feature) {
  return feature <= Feature::Vertex2;
}

}  // namespace

SurfacePoint walkTowards(const BodyMesh& body, TriangleIndex start, const Eigen::Vector3d& target) {
  const SurfaceMesh& surface = body.surface();
  const MeshTopology& topology = body.topology();
  const auto closest_on = [&](TriangleIndex triangle) {
    const PointTriangleDistance d = pointTriangleDistance(target, trianglePoints(surface, triangle));
    return SurfacePoint{triangle, d.feature, d.point, d.squared_distance};
  };
  SurfacePoint best = closest_on(start);
  for (bool moved = true; moved && best.feature != Feature::Face;) {
    moved = false;
    const SurfacePoint from = best;
    const Eigen::Vector3d way = target - from.point;
    const double on_the_spot = 1e-15 * (way.squaredNorm() + from.point.squaredNorm());
    // A triangle that holds the point has a closer one only if one of its corners lies ahead.
    const auto try_triangle = [&](TriangleIndex triangle) {
      const TriangleNodes& nodes = surface.triangle(triangle);
      const bool ahead = std::any_of(nodes.begin(), nodes.end(), [&](NodeIndex node) {
        return way.dot(surface.vertex(node) - from.point) > -on_the_spot;
      });
      if (!ahead) {
        return;
      }
      const SurfacePoint candidate = closest_on(triangle);
      if (candidate.squared_distance < best.squared_distance) {
        best = candidate;
        moved = true;
      }
    };
    if (isVertex(from.feature)) {
      const NodeIndex vertex = surface.triangle(from.triangle)[static_cast<std::size_t>(from.feature)];
      for (const TriangleIndex triangle : topology.triangles_of_vertex.row(vertex.value)) {
        try_triangle(triangle);
      }
    } else {
      const auto edge = static_cast<std::size_t>(from.feature) - static_cast<std::size_t>(Feature::Edge0);
      const TriangleIndex across = topology.triangle_across_edge[from.triangle.value][edge];
      if (across != kNoTriangle) {
        try_triangle(across);
      }
    }
  }
  return best;
}

}  // namespace concave_distance
