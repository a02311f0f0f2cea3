#include "search_nodes.h"

#include <utility>

#include "mesh/surface/grid_size.h"
#include "mesh/surface/refine_mesh.h"
#include "thin_graph.h"

namespace concave_distance {
namespace {

/// Returns for each node the original triangle of the first refined triangle at it.
std::vector<TriangleIndex> originalTriangles(const RefinedMesh& refined) {
  std::vector<TriangleIndex> original(refined.mesh.vertexCount());
  for (std::size_t t = refined.mesh.triangleCount(); t-- > 0;) {
    for (const NodeIndex node : refined.mesh.triangles()[t]) {
      original[node.value] = refined.original_triangle[t];
    }
  }
  return original;
}

}  // namespace

SearchNodes makeSearchNodes(const SurfaceMesh& surface, const BodyMeshOptions& options,
                            const std::string& where) {
  SearchNodes nodes;
  checkEdgeLength(surface, options.max_edge_length, where);
  nodes.max_edge_length = options.max_edge_length.value_or(automaticEdgeLength(surface));
  RefinedMesh refined = refineToEdgeLength(surface, nodes.max_edge_length);
  nodes.original_triangle_of_node = originalTriangles(refined);
  nodes.grid = std::move(refined.mesh);
  nodes.graph = buildNodeGraph(nodes.grid);
  if (!options.max_edge_length) thinNodes(nodes, options.search_node_limit, surface.vertexCount());
  return nodes;
}

void thinNodes(SearchNodes& nodes, std::size_t node_limit, std::size_t vertex_count) {
  if (nodes.graph.nodeCount() <= node_limit) return;
  ThinnedGraph thinned = thinGraph(nodes.graph, node_limit);
  std::vector<TriangleIndex> original_triangles;
  original_triangles.reserve(thinned.original_node.size());
  for (const NodeIndex node : thinned.original_node) {
    original_triangles.push_back(nodes.original_triangle_of_node[node.value]);
  }
  nodes.original_triangle_of_node = std::move(original_triangles);
  thinned.nearest.resize(vertex_count);
  nodes.graph_node_of_vertex = std::move(thinned.nearest);
  nodes.graph = std::move(thinned.graph);
  nodes.max_edge_length = thinned.longest_edge;
}

}  // namespace concave_distance
