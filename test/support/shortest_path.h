#pragma once

#include <cmath>
#include <vector>

#include "search/grid/geodesic_extent.h"

namespace concave_distance::test {

/// Nodes of a shortest path, `from` and `to` included; empty between shells.
inline std::vector<NodeIndex> shortestPath(const NodeGraph& graph, NodeIndex from, NodeIndex to) {
  const std::vector<double> left = pathLengthsFrom(graph, {to});
  std::vector<NodeIndex> path;
  if (!std::isfinite(left[from.value])) return path;
  path.push_back(from);
  while (path.back() != to) {
    const NodeIndex node = path.back();
    for (const NodeGraph::Edge& edge : graph.edges.row(node.value)) {
      // Sums of edge lengths are exact.
      if (edge.length > 0.0F && left[edge.to.value] + static_cast<double>(edge.length) == left[node.value]) {
        path.push_back(edge.to);
        break;
      }
    }
  }
  return path;
}

}  // namespace concave_distance::test
