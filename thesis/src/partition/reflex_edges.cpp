#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "convex_partition.h"
#include "mesh/surface/mesh_topology.h"

namespace concave_distance {

std::size_t countReflexEdges(const SurfaceMesh& mesh) {
  using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
  const MeshTopology topology = buildMeshTopology(mesh);
  const auto point = [&mesh](NodeIndex node) {
    const Eigen::Vector3d& v = mesh.vertex(node);
    return Point(v.x(), v.y(), v.z());
  };
  std::size_t count = 0;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const TriangleNodes& here = mesh.triangle(TriangleIndex{t});
    for (const TriangleIndex across : topology.triangle_across_edge[t]) {
      // Each edge once.
      if (across == kNoTriangle || across.value < t) continue;
      for (const NodeIndex node : mesh.triangle(across)) {
        const bool shared = node == here[0] || node == here[1] || node == here[2];
        // The neighbour rises in front of this triangle.
        if (!shared && CGAL::orientation(point(here[0]), point(here[1]), point(here[2]), point(node)) ==
                           CGAL::POSITIVE) {
          ++count;
        }
      }
    }
  }
  return count;
}

}  // namespace concave_distance
