#include "thesis/benchmark/support/grid_flood.h"

#include <algorithm>
#include <cmath>

namespace concave_distance::benchmark {

std::optional<TrialPoint> floodForDeeper(const PairObjective& objective, const TrialPoint& start,
                                         double level, double noise, std::uint32_t state_limit,
                                         FloodWorkspace& workspace, SearchCost& cost) {
  const NodeGraph& graph_a = objective.gridA().graph();
  const NodeGraph& graph_b = objective.gridB().graph();
  std::vector<TrialPoint>& heap = workspace.heap;
  const auto deeper_last = [](const TrialPoint& l, const TrialPoint& r) { return r < l; };
  const double from = std::sqrt(start.squared_distance);
  const double squared_level = level * level;
  // The square of a rounded root may lie above what it is the root of: never above the start itself.
  const double squared_goal =
      from > noise ? std::min(start.squared_distance, (from - noise) * (from - noise)) : 0.0;
  workspace.seen.clear();
  heap.clear();
  heap.push_back(start);
  workspace.seen.insert(start.node_a, start.node_b, 0);
  std::uint32_t states = 0;
  while (!heap.empty() && states < state_limit) {
    std::pop_heap(heap.begin(), heap.end(), deeper_last);
    const TrialPoint here = heap.back();
    heap.pop_back();
    if (here.squared_distance < squared_goal) {
      return here;
    }
    ++states;
    const auto visit = [&](NodeIndex node_a, NodeIndex node_b) {
      if (workspace.seen.find(node_a, node_b) != PairTable::kAbsent) {
        return;
      }
      workspace.seen.insert(node_a, node_b, 0);
      const TrialPoint next = objective.evaluate(node_a, node_b, cost);
      if (next.squared_distance <= squared_level) {
        heap.push_back(next);
        std::push_heap(heap.begin(), heap.end(), deeper_last);
      }
    };
    for (const NodeGraph::Edge& edge : graph_a.edges.row(here.node_a.value)) {
      visit(edge.to, here.node_b);
    }
    for (const NodeGraph::Edge& edge : graph_b.edges.row(here.node_b.value)) {
      visit(here.node_a, edge.to);
    }
  }
  return std::nullopt;
}

}  // namespace concave_distance::benchmark
