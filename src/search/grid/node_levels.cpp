#include "node_levels.h"

#include <utility>

#include "graph_regions.h"

namespace concave_distance {
namespace {

// Nodes of a coarser level are at least this many mean edges apart.
constexpr double kSpacing = 2.0;

double meanEdge(const NodeGraph& graph) {
  double sum = 0.0;
  for (const NodeGraph::Edge& edge : graph.edges.values) {
    sum += static_cast<double>(edge.length);
  }
  return graph.edges.values.empty() ? 0.0 : sum / static_cast<double>(graph.edges.values.size());
}

/// Every node that is not near one chosen before is chosen.
ThinnedGraph coarsen(const NodeGraph& graph) {
  const double spacing = kSpacing * meanEdge(graph);
  detail::GraphRegions regions(graph);
  for (std::uint32_t node = 0; node < graph.nodeCount(); ++node) {
    if (!(regions.distance()[node] <= spacing)) {
      regions.grow(NodeIndex{node}, spacing);
    }
  }
  return regions.thinned();
}

}  // namespace

NodeLevels buildNodeLevels(const NodeGraph& graph) {
  NodeLevels all;
  if (graph.nodeCount() < NodeLevels::kWorthwhile) {
    return all;
  }
  const NodeGraph* finest = &graph;
  while (finest->nodeCount() > NodeLevels::kCoarsest) {
    ThinnedGraph thinned = coarsen(*finest);
    if (2 * thinned.graph.nodeCount() > finest->nodeCount()) {
      break;
    }
    all.levels.push_back(
        {std::move(thinned.graph), std::move(thinned.original_node), std::move(thinned.nearest)});
    finest = &all.levels.back().graph;
  }
  return all;
}

}  // namespace concave_distance
