#pragma once

#include <cstddef>
#include <vector>

#include "node_graph.h"

namespace concave_distance {

struct ThinnedGraph {
  NodeGraph graph;
  std::vector<NodeIndex> original_node;  ///< per node of the thinned graph, the one it was
  std::vector<NodeIndex> nearest;        ///< per original node, the one of the thinned graph it belongs to
  double longest_edge = 0.0;             ///< metres
};

/// An evenly spread choice of nodes: each next one is the farthest, along the edges, from those chosen
/// (Gonzalez 1985), starting with the first node of each shell. Two chosen nodes are neighbours where their
/// regions (nodes nearer to one than to any other) touch, so shells keep together. Vertices of a tessellated
/// part are dense where it is round, not where niches are: an even choice finds more niches a descent.
/// At least one node a shell, so more than `node_count` when there are more shells. Deterministic.
/// O(n log n) in practice: a region grows only where it is nearer than all before.
ThinnedGraph thinGraph(const NodeGraph& graph, std::size_t node_count);

}  // namespace concave_distance
