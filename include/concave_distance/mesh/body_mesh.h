#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "concave_distance/mesh/bounding_volume_hierarchy.h"
#include "concave_distance/mesh/connected_pieces.h"
#include "concave_distance/mesh/mesh_metric.h"
#include "concave_distance/mesh/mesh_topology.h"
#include "concave_distance/mesh/metric_memory.h"
#include "concave_distance/mesh/node_graph.h"
#include "concave_distance/mesh/normal_cone_tree.h"
#include "concave_distance/mesh/preparation_cache.h"
#include "concave_distance/mesh/search_nodes.h"
#include "concave_distance/mesh/surface_mesh.h"
#include "concave_distance/mesh/triangle_adjacency.h"
#include "concave_distance/mesh/triangle_tree.h"

namespace concave_distance {

struct BodyMeshOptions {
  /// Grid size of the search, metres: the longest edge between nodes. Empty: automaticEdgeLength().
  std::optional<double> max_edge_length;
  /// With an automatic grid, nodes of the search graph at the most: a finer mesh is thinned to evenly spread
  /// nodes (thinGraph). An explicit grid size is taken as it is.
  std::size_t search_node_limit = 800;
  /// Coarser levels over fine grids, for descents in long steps; only a comparison is without.
  bool levels = true;
  /// Largest number of nodes of the grid, compared with an estimate before it is made (estimatedNodeCount).
  std::size_t largest_node_count = 20'000'000;
  MeshMetricOptions metric;
  /// Limit for the matrices of the metric; without room in it none are made. nullptr: no limit.
  std::shared_ptr<MetricMemory> metric_memory;
  /// Where prepared parts are looked for and stored; nullptr: nowhere.
  PreparationCachePointer cache;
};

/// Everything of a body except its mesh metric, for a search on other nodes than the grid's.
struct BodyMeshParts {
  std::string name;
  SurfaceMesh surface;
  MeshTopology topology;
  TriangleTree tree;
  BoundingVolumeHierarchy hierarchy;
  SearchNodes nodes;
  PreparationCachePointer cache;  ///< for the metric
  ContentKey nodes_key;           ///< in the cache
};

/// Makes the parts, those that do not need each other in parallel; the same whatever the number of threads.
/// @param surface repaired, original triangles, body frame, metres
/// @throws Error (naming the body) for options out of range
BodyMeshParts makeBodyMeshParts(std::string name, SurfaceMesh surface, const BodyMeshOptions& options);

/// One body, ready for queries: the original surface with its topology and tree for the exact levels, the
/// even grid (makeSearchGrid) with its graph and metric for the search. Immutable to its users; shared
/// between pairs and threads. What only a search needs is made at its first use, once for all threads; a body
/// that is never searched has none of it.
class BodyMesh {
 public:
  /// @param surface repaired, original triangles, body frame, metres
  /// @throws Error (naming the body) for options out of range, or for a grid of more nodes than they allow
  BodyMesh(std::string name, SurfaceMesh surface, const BodyMeshOptions& options);
  BodyMesh(BodyMeshParts parts, const MeshMetricOptions& metric);
  ~BodyMesh();
  BodyMesh(const BodyMesh&) = delete;
  BodyMesh& operator=(const BodyMesh&) = delete;

  /// Name of the body that it was made for; others of the same content may share it.
  const std::string& name() const { return parts_.name; }
  const SurfaceMesh& surface() const { return parts_.surface; }
  const MeshTopology& topology() const { return parts_.topology; }
  const TriangleTree& tree() const { return parts_.tree; }
  const BoundingVolumeHierarchy& hierarchy() const { return parts_.hierarchy; }
  /// Which triangles hang together. Built at the first call, for all threads; 40 bytes a triangle.
  const CompressedRows<AdjacentTriangle>& adjacency() const;
  /// What hangs together as a whole. Built at the first call, for all threads; 4 bytes a triangle.
  const ConnectedPieces& pieces() const;
  /// Of level `complete`. Built at the first call for each of the two, for all threads; about 450 bytes a
  /// triangle.
  const NormalConeTree& normalCones(NormalSides sides) const;
  const SurfaceMesh& grid() const { return nodes().grid; }
  /// What the search moves on: the grid's nodes or, where thinned() says so, an even choice of them.
  const NodeGraph& graph() const { return nodes().graph; }
  /// Coarser and coarser graphs over graph().
  const NodeLevels& levels() const { return nodes().levels; }
  bool thinned() const { return nodes().thinned(); }
  const MeshMetric& metric() const;
  double maxEdgeLength() const { return nodes().max_edge_length; }
  double diameter() const { return parts_.surface.diameter(); }
  /// How long the ways on the body are, and how near its protrusions come to each other along the mesh (at
  /// most half as far), metres: what the radii of niching are chosen from (mesh/geodesic_extent.h).
  double geodesicExtent() const;
  double protrusionSpacing() const;
  /// An original triangle that the graph's node lies on.
  TriangleIndex originalTriangle(NodeIndex graph_node) const {
    return nodes().original_triangle_of_node[graph_node.value];
  }
  /// The graph's node that a vertex of the original surface is, or belongs to where the graph is thinned.
  NodeIndex graphNode(NodeIndex surface_vertex) const {
    return thinned() ? nodes().graph_node_of_vertex[surface_vertex.value] : surface_vertex;
  }
  /// The grid with its graph; nullptr until a search needs it.
  const SearchNodes* nodesIfMade() const { return nodes_.load(std::memory_order_acquire); }
  const MeshMetric* metricIfMade() const;
  /// Memory of the parts made so far.
  std::size_t memoryBytes() const;

 private:
  const SearchNodes& nodes() const {
    const SearchNodes* made = nodesIfMade();
    return made != nullptr ? *made : makeNodes();
  }
  const SearchNodes& makeNodes() const;
  struct Measured;
  const Measured& measured() const;
  void reserveMetric() const;
  friend void prepareSearch(const std::vector<const BodyMesh*>& bodies);

  BodyMeshParts parts_;  ///< without the nodes
  BodyMeshOptions options_;
  struct OnDemand;
  std::unique_ptr<OnDemand> on_demand_;                     ///< what not every level needs
  mutable std::atomic<const SearchNodes*> nodes_{nullptr};  ///< set once, in on_demand_
};

/// Bodies with the same key differ only in their names.
ContentKey bodyKey(const SurfaceMesh& surface, const BodyMeshOptions& options);

/// Makes the missing parts that a search of these bodies needs, in parallel. Room for matrices is given in
/// this order, so that it does not depend on the threads.
void prepareSearch(const std::vector<const BodyMesh*>& bodies);

}  // namespace concave_distance
