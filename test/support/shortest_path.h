#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "search/grid/mesh_metric.h"

namespace concave_distance::test {

/// Nodes of a shortest path, `from` and `to` included; empty between shells.
inline std::vector<NodeIndex> shortestPath(const NodeGraph& graph, NodeIndex from, NodeIndex to) {
  const MeshMetric metric(graph, graph.nodeCount());
  std::vector<NodeIndex> path;
  if (!std::isfinite(metric.matrixDistance(from, to))) return path;
  for (NodeIndex node = to; node != from; node = metric.matrixPredecessor(from, node)) path.push_back(node);
  path.push_back(from);
  std::reverse(path.begin(), path.end());
  return path;
}

}  // namespace concave_distance::test
