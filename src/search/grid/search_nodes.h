#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "concave_distance/mesh/body_mesh.h"
#include "node_graph.h"
#include "node_levels.h"
#include "search_grid.h"

namespace concave_distance {

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
  TriangleIndex originalTriangle(NodeIndex node) const { return original_triangle_of_node[node.value]; }
  /// The graph's node that a vertex of the original surface is, or belongs to where the graph is thinned.
  NodeIndex graphNode(NodeIndex surface_vertex) const {
    return thinned() ? graph_node_of_vertex[surface_vertex.value] : surface_vertex;
  }
};

/// O(n log n). @throws Error (naming `where`) when the edge length is not positive and finite; as
/// makeSearchGrid()
SearchNodes makeSearchNodes(const SurfaceMesh& surface, const BodyMeshOptions& options,
                            const std::string& where);

}  // namespace concave_distance
