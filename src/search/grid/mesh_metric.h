#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "node_graph.h"

namespace concave_distance {

/// The mesh distance delta and its shortest paths (Carretero, sec. 3.1.2; Dijkstra 1959), kept in matrices of
/// at most so many nodes as are asked for. Of a larger graph they hold evenly spread nodes (thinGraph()), and
/// every other node stands where the one that its region belongs to does. Immutable, shared between threads.
/// Path lengths are summed exactly (NodeGraph::Edge), so a distance in the matrices is the exact minimum
/// rounded once to float: exactly symmetric, never below the straight distance by more than 2^-24 relative,
/// and d(a,c) <= (d(a,b) + d(b,c)) (1 + 2^-22).
class MeshMetric {
 public:
  /// Builds the distance and predecessor matrices in parallel, O(n^2 log n) for n of their nodes, 4 + 2 bytes
  /// an entry. Where the graph has more shells than the limit allows nodes, nothing is stored: what lies on
  /// one shell is at distance 0.
  /// @param graph must outlive the metric
  /// @param matrix_node_limit at most 65535 counts, the range of a predecessor
  MeshMetric(const NodeGraph& graph, std::size_t matrix_node_limit);
  /// Bytes that the matrices of this many nodes take.
  static std::size_t matrixBytes(std::size_t node_count) {
    return node_count * node_count * (sizeof(float) + sizeof(std::uint16_t));
  }
  const NodeGraph& graph() const { return *graph_; }
  /// Returns whether the matrices hold fewer nodes than the graph has.
  bool isThinned() const { return !owner_.empty(); }
  /// delta(from, to), metres; infinity between shells. O(1).
  double distance(NodeIndex from, NodeIndex to) const {
    const std::size_t row = ownerOf(from);
    const std::size_t column = ownerOf(to);
    if (row == column) return 0.0;
    return distance_.empty() ? std::numeric_limits<double>::infinity()
                             : static_cast<double>(distance_[row * size_ + column]);
  }
  /// The last node of the matrices within `distance` of `from`, metres, on a shortest path to `to`; `from`
  /// itself when there is no path or no such node. O(nodes walked).
  NodeIndex nodeTowards(NodeIndex from, NodeIndex to, double distance) const;

 private:
  void fill(const NodeGraph& graph);
  std::size_t ownerOf(NodeIndex node) const { return owner_.empty() ? node.value : owner_[node.value].value; }

  const NodeGraph* graph_;
  std::size_t size_;                        ///< nodes of the matrices
  std::vector<NodeIndex> node_;             ///< per node of the matrices, the graph's; empty: the same
  std::vector<NodeIndex> owner_;            ///< per node of the graph, that of the matrices; empty: the same
  std::vector<float> distance_;             ///< row by row
  std::vector<std::uint16_t> predecessor_;  ///< the last node before the column's on the path from the row's
};

}  // namespace concave_distance
