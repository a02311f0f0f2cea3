#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"
#include "node_graph.h"
#include "node_levels.h"
#include "search_grid.h"

namespace concave_distance {

struct SearchNodesOptions {
  /// Grid size of the search, metres: the longest edge between nodes. Empty: automaticEdgeLength().
  std::optional<double> max_edge_length;
  /// With an automatic grid, nodes of the search graph, at most: a finer mesh is thinned to evenly spread
  /// nodes (thinGraph). An explicit grid size is taken as it is.
  std::size_t node_limit = 800;
};

/// Holds what the search moves on: the even grid over a surface and its graph, thinned where the mesh itself
/// is finer than the search wants.
struct SearchNodes {
  SurfaceMesh grid;
  NodeGraph graph;
  NodeLevels levels;             ///< over the graph
  double max_edge_length = 0.0;  ///< metres
  /// An original triangle that each node of the graph lies on.
  std::vector<TriangleIndex> original_triangle_of_node;
  /// The graph's node that each vertex of the surface belongs to; empty unless the graph is thinned.
  std::vector<NodeIndex> graph_node_of_vertex;

  bool thinned() const { return graph.nodeCount() < grid.vertexCount(); }
};

/// O(n log n). @throws Error (naming `where`) when the edge length is not positive and finite; as
/// makeSearchGrid()
SearchNodes makeSearchNodes(const SurfaceMesh& surface, const SearchNodesOptions& options,
                            const std::string& where);

}  // namespace concave_distance
