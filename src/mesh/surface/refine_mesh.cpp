#include "refine_mesh.h"

#include <numeric>
#include <queue>

#include "editable_mesh.h"

namespace concave_distance {

namespace {

// The longest edge of all is the longest of each of its triangles: taking edges in descending order is
// Rivara's longest-edge bisection without its propagation path, and the mesh conforms after every split.
struct Candidate {
  double squared_length;
  std::uint32_t edge;
  bool operator<(const Candidate& r) const {  // longest first, then the lowest number
    return squared_length != r.squared_length ? squared_length < r.squared_length : edge > r.edge;
  }
};

}  // namespace

RefinedMesh refineToEdgeLength(const SurfaceMesh& mesh, double max_edge_length, std::size_t node_limit) {
  detail::checkRefinement(mesh, max_edge_length);
  detail::checkNodeLimit(mesh, max_edge_length, node_limit);
  std::vector<std::uint32_t> original_triangle(mesh.triangleCount());
  std::iota(original_triangle.begin(), original_triangle.end(), 0U);
  detail::EditableMesh editable(mesh, std::move(original_triangle));
  const double squared_limit = max_edge_length * max_edge_length;
  std::vector<Candidate> initial;
  for (std::size_t e = 0; e < editable.edgeCount(); ++e) {
    const double squared_length = editable.squaredLength(e);
    if (squared_length > squared_limit) {
      initial.push_back({squared_length, static_cast<std::uint32_t>(e)});
    }
  }
  std::priority_queue<Candidate> candidates({}, std::move(initial));
  while (!candidates.empty()) {
    if (editable.vertices().size() >= node_limit) {
      detail::throwTooManyNodes(max_edge_length, node_limit);
    }
    const std::size_t edge = candidates.top().edge;
    candidates.pop();
    const auto consider = [&](std::size_t e) {
      const double squared_length = editable.squaredLength(e);
      if (squared_length > squared_limit) {
        candidates.push({squared_length, static_cast<std::uint32_t>(e)});
      }
    };
    const std::size_t edges_before = editable.edgeCount();
    const Eigen::Vector3d& a = editable.vertices()[editable.edge(edge).a.value];
    const Eigen::Vector3d& b = editable.vertices()[editable.edge(edge).b.value];
    editable.split(edge, 0.5 * (a + b));
    consider(edge);
    for (std::size_t e = edges_before; e < editable.edgeCount(); ++e) {
      consider(e);
    }
  }
  RefinedMesh refined;
  for (const std::uint32_t tag : editable.releaseTags()) {
    refined.original_triangle.emplace_back(tag);
  }
  refined.mesh = SurfaceMesh(editable.releaseVertices(), editable.releaseTriangles(), "refined mesh");
  return refined;
}

}  // namespace concave_distance
