#pragma once

#include <cstddef>
#include <vector>

#include "node_graph.h"

namespace concave_distance {

/// A coarser graph over some of the nodes of a finer one.
struct NodeLevel {
  NodeGraph graph;
  std::vector<NodeIndex> finer_node;     ///< per node, the one of the finer graph that it is
  std::vector<NodeIndex> node_of_finer;  ///< per node of the finer graph, the one here that it belongs to
};

/// Coarser and coarser graphs over a search graph, the next coarser first, for a walk whose steps grow with
/// the way it has gone. The nodes of a level are apart by more than twice the mean edge of the finer graph,
/// and none of that is farther from its own than this: about a sixth of the nodes. Two are neighbours where
/// their regions touch, so shells keep apart. Ends at kCoarsest nodes, or where thinning leaves more than
/// half (many shells). Deterministic; O(n log n) to build; together about a quarter of the graph's memory.
struct NodeLevels {
  static constexpr std::size_t kWorthwhile = 2000;
  static constexpr std::size_t kCoarsest = 150;

  std::vector<NodeLevel> levels;
};

NodeLevels buildNodeLevels(const NodeGraph& graph);

}  // namespace concave_distance
