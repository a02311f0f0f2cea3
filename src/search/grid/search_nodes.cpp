#include "search_nodes.h"

#include <utility>

#include "mesh/surface/grid_size.h"
#include "thin_graph.h"

namespace concave_distance {

SearchNodes makeSearchNodes(const SurfaceMesh& surface, const BodyMeshOptions& options,
                            const std::string& where) {
  SearchNodes nodes;
  checkEdgeLength(surface, options.max_edge_length, where);
  nodes.max_edge_length = options.max_edge_length.value_or(automaticEdgeLength(surface));
  SearchGrid grid = makeSearchGrid(surface, nodes.max_edge_length);
  nodes.grid = std::move(grid.mesh);
  nodes.graph = buildNodeGraph(nodes.grid);
  nodes.original_triangle_of_node = std::move(grid.original_triangle_of_node);
  if (options.max_edge_length || nodes.graph.nodeCount() <= options.search_node_limit) {
    nodes.levels = buildNodeLevels(nodes.graph);
    return nodes;
  }
  ThinnedGraph thinned = thinGraph(nodes.graph, options.search_node_limit);
  std::vector<TriangleIndex> original_triangles;
  original_triangles.reserve(thinned.original_node.size());
  for (const NodeIndex node : thinned.original_node) {
    original_triangles.push_back(nodes.original_triangle_of_node[node.value]);
  }
  nodes.original_triangle_of_node = std::move(original_triangles);
  thinned.nearest.resize(surface.vertexCount());  // the grid's first nodes are the surface's vertices
  nodes.graph_node_of_vertex = std::move(thinned.nearest);
  nodes.graph = std::move(thinned.graph);
  nodes.max_edge_length = thinned.longest_edge;
  nodes.levels = buildNodeLevels(nodes.graph);
  return nodes;
}

}  // namespace concave_distance
