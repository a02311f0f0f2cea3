#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "concave_distance/mesh/node_graph.h"

namespace concave_distance {

struct MeshMetricOptions {
  /// Up to this many nodes the distance and predecessor matrices are kept (4 + 2 bytes an entry); beyond,
  /// bounded searches on demand with a cache, memory linear in nodes.
  std::size_t matrix_node_limit = 4096;
};

/// The mesh distance delta and its shortest paths (Carretero, sec. 3.1.2; Dijkstra 1959). Immutable, shared
/// between threads; queries go through a MeshMetricQuery, one per thread.
/// Symmetric and obeys the triangle inequality up to float rounding: relative error at most
/// (edges on the path + 1) * 2^-24.
class MeshMetric {
 public:
  MeshMetric(const NodeGraph& graph, const MeshMetricOptions& options);  ///< the graph must outlive it
  bool hasMatrices() const { return !distance_.empty(); }
  const NodeGraph& graph() const { return *graph_; }
  /// Matrix entry, metres; infinity between shells. Only when hasMatrices().
  float matrixDistance(NodeIndex from, NodeIndex to) const {
    return distance_[from.value * node_count_ + to.value];
  }
  /// Last node before `to` on the path from `from` (the matrix P). Only when hasMatrices().
  NodeIndex matrixPredecessor(NodeIndex from, NodeIndex to) const {
    return NodeIndex{std::uint32_t{predecessor_[from.value * node_count_ + to.value]}};
  }
  std::size_t memoryBytes() const;

 private:
  const NodeGraph* graph_;
  std::size_t node_count_;
  std::vector<float> distance_;
  std::vector<std::uint16_t> predecessor_;
};

/// Buffers and cache for one thread's queries; allocates only while warming up.
class MeshMetricQuery {
 public:
  explicit MeshMetricQuery(const MeshMetric& metric);

  /// delta(from, to) when it is at most `bound`, else infinity (also between shells). Metres.
  double distanceWithin(NodeIndex from, NodeIndex to, double bound);

  /// Nodes of a shortest path, `from` and `to` included; empty between shells. `path` keeps its capacity.
  /// Beyond the matrices the search is guided and bounded; the path is still a shortest one.
  void shortestPath(NodeIndex from, NodeIndex to, std::vector<NodeIndex>& path);

 private:
  struct CachedSource {
    NodeIndex source;
    double radius = -1.0;  ///< everything within is settled
    std::uint64_t last_use = 0;
    std::vector<std::pair<NodeIndex, float>> settled;  ///< ascending by node
  };
  const MeshMetric* metric_;
  std::vector<CachedSource> cache_;
  std::uint64_t clock_ = 0;
  std::vector<float> tentative_;
  std::vector<NodeIndex> predecessor_;
  std::vector<NodeIndex> touched_;
  std::vector<std::pair<float, NodeIndex>> heap_;
};

}  // namespace concave_distance
