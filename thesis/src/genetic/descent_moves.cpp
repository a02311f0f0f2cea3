#include "descent_moves.h"

#include "search/local_descent.h"

namespace concave_distance {
namespace {

/// Moves to the closest pair of neighbours; of equals the smallest indices stay. False when none is closer.
bool moveBothNodes(const PairObjective& objective, Descent& descent, SearchCost& cost) {
  const TrialPoint& point = descent.point();
  const auto neighbours_a = objective.gridA().graph().edges.row(point.node_a.value);
  const auto neighbours_b = objective.gridB().graph().edges.row(point.node_b.value);
  TrialPoint closest = point;
  for (const NodeGraph::Edge& edge_b : neighbours_b) {
    const Eigen::Vector3d neighbour_in_a =
        objective.aFromB() * objective.gridB().graph().positions[edge_b.to.value];
    for (const NodeGraph::Edge& edge_a : neighbours_a) {
      const double candidate =
          squaredDistanceBetween(objective.gridA().graph().positions[edge_a.to.value], neighbour_in_a);
      if (candidate < closest.squared_distance) closest = {edge_a.to, edge_b.to, candidate};
    }
  }
  cost.evaluations += neighbours_a.size() * neighbours_b.size();
  if (samePlace(closest, point)) return false;
  ++cost.descent_steps;
  descent.moveTo(closest);
  return true;
}

}  // namespace

TrialPoint descendBy(DescentMoves moves, const PairObjective& objective, const TrialPoint& start,
                     BasinMemory* memory, std::vector<std::uint64_t>& trail, SearchCost& cost) {
  if (moves == DescentMoves::OneNode) return descend(objective, start, memory, trail, cost);
  Descent descent(objective, memory, trail, cost);
  descent.begin(start);
  while (descent.run() && moveBothNodes(objective, descent, cost)) {
  }
  return descent.end();
}

}  // namespace concave_distance
