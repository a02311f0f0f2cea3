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

/// The grid the search needs, chosen for recall and not for accuracy (the exact levels use the original
/// triangles): a stated fraction of the body's diameter, not below what keeps the node count within a few
/// thousand.
double automaticEdgeLength(const SurfaceMesh& surface);

/// Rough number of grid nodes for this edge length, from the area and the lengths of the edges. O(n).
double estimatedNodeCount(const SurfaceMesh& surface, double max_edge_length);

/// @throws Error (naming `where`) when the edge length is not positive and finite, or a triangle has a corner
///         twice
void checkEdgeLength(const SurfaceMesh& surface, const std::optional<double>& max_edge_length,
                     const std::string& where);

/// O(n log n). @throws Error (naming `where`) when the edge length is not positive and finite; as
/// makeSearchGrid()
SearchNodes makeSearchNodes(const SurfaceMesh& surface, const SearchNodesOptions& options,
                            const std::string& where);

}  // namespace concave_distance
