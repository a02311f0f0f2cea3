#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "concave_distance/mesh/bounding_volume_hierarchy.h"
#include "concave_distance/mesh/mesh_metric.h"
#include "concave_distance/mesh/mesh_topology.h"
#include "concave_distance/mesh/node_graph.h"
#include "concave_distance/mesh/search_grid.h"
#include "concave_distance/mesh/surface_mesh.h"
#include "concave_distance/mesh/triangle_tree.h"

namespace concave_distance {

struct BodyMeshOptions {
  /// Grid size of the search, metres: the longest edge between nodes. Empty: automaticEdgeLength().
  std::optional<double> max_edge_length;
  /// With an automatic grid, nodes of the search graph at the most: a finer mesh is thinned to evenly spread
  /// nodes (thinGraph). An explicit grid size is taken as it is.
  std::size_t search_node_limit = 800;
  MeshMetricOptions metric;
};

/// The grid the search needs, chosen for recall and not for accuracy (the exact levels use the original
/// triangles): a stated fraction of the body's diameter, not below what keeps the node count within a few
/// thousand.
double automaticEdgeLength(const SurfaceMesh& surface);

/// One body, ready for queries: the original surface with its topology and tree for the exact levels, the
/// even grid (makeSearchGrid) with its graph and metric for the search. Immutable; shared between pairs and
/// threads.
class BodyMesh {
 public:
  /// @param surface repaired, original triangles, body frame, metres
  /// @throws Error (naming the body) for options out of range
  BodyMesh(std::string name, SurfaceMesh surface, const BodyMeshOptions& options);
  BodyMesh(const BodyMesh&) = delete;
  BodyMesh& operator=(const BodyMesh&) = delete;

  const std::string& name() const { return name_; }
  const SurfaceMesh& surface() const { return surface_; }
  const MeshTopology& topology() const { return topology_; }
  const TriangleTree& tree() const { return tree_; }
  const BoundingVolumeHierarchy& hierarchy() const { return hierarchy_; }
  const SurfaceMesh& grid() const { return grid_.mesh; }
  /// What the search moves on: the grid's nodes or, where thinned() says so, an even choice of them.
  const NodeGraph& graph() const { return graph_; }
  bool thinned() const { return graph_.nodeCount() < grid_.mesh.vertexCount(); }
  const MeshMetric& metric() const { return *metric_; }
  double maxEdgeLength() const { return max_edge_length_; }
  double diameter() const { return surface_.diameter(); }
  /// How long the ways on the body are, and how near its protrusions come to each other along the mesh (at
  /// most half as far), metres: what the radii of niching are chosen from (mesh/geodesic_extent.h).
  double geodesicExtent() const { return geodesic_extent_; }
  double protrusionSpacing() const { return protrusion_spacing_; }
  /// An original triangle that the graph's node lies on.
  TriangleIndex originalTriangle(NodeIndex graph_node) const {
    return original_triangle_of_node_[graph_node.value];
  }
  /// The graph's node that a vertex of the original surface is, or belongs to where the graph is thinned.
  NodeIndex graphNode(NodeIndex surface_vertex) const {
    return thinned() ? graph_node_of_vertex_[surface_vertex.value] : surface_vertex;
  }
  std::size_t memoryBytes() const;

 private:
  std::string name_;
  SurfaceMesh surface_;
  MeshTopology topology_;
  TriangleTree tree_;
  BoundingVolumeHierarchy hierarchy_;
  double max_edge_length_;
  SearchGrid grid_;
  NodeGraph graph_;
  std::vector<TriangleIndex> original_triangle_of_node_;
  std::vector<NodeIndex> graph_node_of_vertex_;  ///< empty unless thinned
  std::unique_ptr<MeshMetric> metric_;
  double geodesic_extent_;
  double protrusion_spacing_;
};

}  // namespace concave_distance
