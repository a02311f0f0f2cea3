#include "concave_distance/mesh/search_nodes.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "concave_distance/base/error.h"
#include "concave_distance/mesh/thin_graph.h"

namespace concave_distance {
namespace {

// Nodes that the automatic grid aims at when the mesh itself has fewer.
constexpr double kTargetNodeCount = 650.0;
// Nodes along the diameter at the most: edges are divided too, and a needle has next to no area.
constexpr double kMostNodesAlong = kTargetNodeCount / 4.0;

double edgeLengthOf(const SurfaceMesh& surface, const std::optional<double>& given,
                    const std::string& where) {
  if (!given) {
    return automaticEdgeLength(surface);
  }
  if (!(*given > 0.0) || !std::isfinite(*given)) {
    throw Error(where, "max_edge_length is " + std::to_string(*given),
                "give a positive, finite length in metres or leave it out");
  }
  return *given;
}

}  // namespace

double automaticEdgeLength(const SurfaceMesh& surface) {
  double area = 0.0;
  for (const TriangleNodes& t : surface.triangles()) {
    area += 0.5 * (surface.vertex(t[1]) - surface.vertex(t[0]))
                      .cross(surface.vertex(t[2]) - surface.vertex(t[0]))
                      .norm();
  }
  // makeSearchGrid spends 1.3 to 1.5 nodes on a squared edge length of area; a body that is long and thin
  // would get edges longer than it is thick, hence the second term.
  const double length = std::min(std::sqrt(1.5 * area / kTargetNodeCount), surface.diameter() / 8.0);
  return std::max(length, surface.diameter() / kMostNodesAlong);
}

SearchNodes makeSearchNodes(const SurfaceMesh& surface, const SearchNodesOptions& options,
                            const std::string& where) {
  SearchNodes nodes;
  nodes.max_edge_length = edgeLengthOf(surface, options.max_edge_length, where);
  SearchGrid grid = makeSearchGrid(surface, nodes.max_edge_length);
  nodes.grid = std::move(grid.mesh);
  nodes.graph = buildNodeGraph(nodes.grid);
  nodes.original_triangle_of_node = std::move(grid.original_triangle_of_node);
  if (options.max_edge_length || nodes.graph.nodeCount() <= options.node_limit) {
    if (options.levels) nodes.levels = buildNodeLevels(nodes.graph);
    return nodes;
  }
  ThinnedGraph thinned = thinGraph(nodes.graph, options.node_limit);
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
  if (options.levels) nodes.levels = buildNodeLevels(nodes.graph);
  return nodes;
}

}  // namespace concave_distance
