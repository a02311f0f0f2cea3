#include "descent_moves.h"

#include "search/local_descent.h"

namespace concave_distance {
namespace {

class DescentOfBothNodes : public Descent {
 public:
  using Descent::Descent;

 private:
  /// Moves to the closest pair of neighbours when it is closer; of equals the smallest indices stay.
  bool moveOn() override {
    TrialPoint closest = point_;
    for (const NodeGraph::Edge& edge_b : graph_b_.edges.row(point_.node_b.value)) {
      const Eigen::Vector3d neighbour_in_a = objective_.aFromB() * graph_b_.positions[edge_b.to.value];
      for (const NodeGraph::Edge& edge_a : graph_a_.edges.row(point_.node_a.value)) {
        const double candidate = squaredDistanceBetween(graph_a_.positions[edge_a.to.value], neighbour_in_a);
        if (candidate < closest.squared_distance) closest = {edge_a.to, edge_b.to, candidate};
      }
    }
    cost_.evaluations +=
        graph_a_.edges.row(point_.node_a.value).size() * graph_b_.edges.row(point_.node_b.value).size();
    if (samePlace(closest, point_)) return false;
    ++cost_.descent_steps;
    moveTo(closest);
    return true;
  }
};

}  // namespace

TrialPoint descendBy(DescentMoves moves, const PairObjective& objective, const TrialPoint& start,
                     BasinMemory* memory, std::vector<std::uint64_t>& trail, SearchCost& cost) {
  if (moves == DescentMoves::BothNodes) return DescentOfBothNodes(objective, memory, trail, cost).from(start);
  return Descent(objective, memory, trail, cost, moves == DescentMoves::OneNode).from(start);
}

}  // namespace concave_distance
