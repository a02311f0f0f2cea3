#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "node_graph.h"

namespace concave_distance {

/// The mesh distance delta and its shortest paths (Carretero, sec. 3.1.2; Dijkstra 1959). Immutable, shared
/// between threads; queries go through a MeshMetricQuery, one per thread.
/// Path lengths are summed exactly (NodeGraph::Edge), so a distance is the exact minimum rounded once to
/// float: exactly symmetric, the same with matrices and without, never below the straight distance by more
/// than 2^-24 relative, and d(a,c) <= (d(a,b) + d(b,c)) (1 + 2^-22).
class MeshMetric {
 public:
  /// Builds the distance and predecessor matrices in parallel, O(n^2 log n), when the graph is small enough.
  /// @param graph must outlive the metric
  /// @param matrix_node_limit up to this many nodes (at most 65535, the range of a predecessor) matrices are
  ///        kept, 4 + 2 bytes an entry; beyond it, distances are searched on demand within a bound and
  ///        cached, memory linear in nodes
  MeshMetric(const NodeGraph& graph, std::size_t matrix_node_limit);
  /// Whether a graph of so many nodes gets matrices.
  static bool wantsMatrices(std::size_t node_count, std::size_t matrix_node_limit);
  /// Bytes that the matrices of this many nodes take.
  static std::size_t matrixBytes(std::size_t node_count) {
    return node_count * node_count * (sizeof(float) + sizeof(std::uint16_t));
  }
  bool hasMatrices() const { return has_matrices_; }
  const NodeGraph& graph() const { return *graph_; }
  /// Matrix entry, metres; infinity between shells. Only when hasMatrices().
  float matrixDistance(NodeIndex from, NodeIndex to) const {
    return distance_[from.value * node_count_ + to.value];
  }
  /// Last node before `to` on the path from `from` (the matrix P); `from` itself when they are equal.
  /// Only when hasMatrices() and both lie on one shell.
  NodeIndex matrixPredecessor(NodeIndex from, NodeIndex to) const {
    return NodeIndex{std::uint32_t{predecessor_[from.value * node_count_ + to.value]}};
  }

 private:
  const NodeGraph* graph_;
  std::size_t node_count_;
  bool has_matrices_;
  std::vector<float> distance_;
  std::vector<std::uint16_t> predecessor_;
};

/// Buffers and cache for one thread's queries. With matrices it holds nothing; without, the first query
/// allocates it: 250 bytes a node, for small meshes up to 3 MB.
class MeshMetricQuery {
 public:
  explicit MeshMetricQuery(const MeshMetric& metric);
  const MeshMetric& metric() const { return *metric_; }

  /// delta(from, to) when it is at most `bound`, else infinity (also between shells). Metres.
  /// O(1) with matrices and when a ball around either node is cached; else O(b log b) for the b nodes within
  /// `bound` of `from`. Balls are dropped in the order they came.
  double distanceWithin(NodeIndex from, NodeIndex to, double bound);

  /// The last node within `distance` of `from`, metres, on a shortest path to `to`; `from` itself when there
  /// is no path or none within `bound`. O(nodes walked) where distanceWithin() is O(1).
  NodeIndex nodeTowards(NodeIndex from, NodeIndex to, double distance, double bound);

  /// Beyond the matrices only: a node within `radius` of `from`, all about equally likely when `fraction` is
  /// uniform in [0, 1).
  NodeIndex nodeInBall(NodeIndex from, double radius, double fraction);

 private:
  /// A seat in a ball's hash table.
  struct BallEntry {
    std::uint32_t node;  ///< kNoNode where the seat is free
    float distance;
    std::uint32_t predecessor;  ///< next node on the way to the ball's source
  };
  /// Says what one bounded search settled: the hash table ball_entries_[first, first + seats).
  struct Ball {
    NodeIndex source;
    double radius;
    std::size_t first;
    std::size_t seats;
  };
  struct Reached {
    float key;
    std::uint32_t node;
  };
  void allocate();
  void clearSearch();
  void reach(NodeIndex node, double path_length, NodeIndex predecessor);
  const Ball* cachedBall(NodeIndex source, double radius) const;
  const Ball& searchBall(NodeIndex source, double radius);
  const Ball& storeBall(NodeIndex source, double radius);
  std::size_t makeRoom(std::size_t seats);
  void dropOldestBall();
  bool cannotReach(NodeIndex from, NodeIndex to, double bound) const;
  const BallEntry* find(const Ball& ball, NodeIndex node) const;

  const MeshMetric* metric_;
  std::vector<BallEntry> ball_entries_;  ///< ring: the next ball overwrites the oldest ones
  std::vector<Ball> balls_;              ///< ring as well, in the same order
  std::size_t oldest_ball_ = 0;
  std::size_t ball_count_ = 0;
  std::size_t next_entry_ = 0;
  std::vector<std::uint32_t> ball_of_node_;  ///< slot in balls_ or kNoBall
  std::vector<double> path_length_;          ///< of the running search; infinity where not reached
  std::vector<NodeIndex> predecessor_;
  std::vector<NodeIndex> reached_;
  std::vector<Reached> open_;
};

}  // namespace concave_distance
