#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "concave_distance/mesh/body_mesh.h"
#include "node_graph.h"

namespace concave_distance {

/// Holds what the search moves on: a grid over a surface and its graph, thinned where the mesh itself is
/// finer than the search wants.
struct SearchNodes {
  SurfaceMesh grid;
  NodeGraph graph;
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

/// Bisects the surface (refineToEdgeLength()) and thins an automatic grid to
/// BodyMeshOptions::search_node_limit. O(n log n).
/// @throws Error (naming `where`) when the edge length is not positive and finite; as refineToEdgeLength()
SearchNodes makeSearchNodes(const SurfaceMesh& surface, const BodyMeshOptions& options,
                            const std::string& where);

/// Thins the graph to so many nodes, where it has more. @param vertex_count of the surface, whose vertices
/// are the first nodes
void thinNodes(SearchNodes& nodes, std::size_t node_limit, std::size_t vertex_count);

}  // namespace concave_distance
