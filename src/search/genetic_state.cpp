#include "genetic_state.h"

#include <algorithm>

#include "local_descent.h"

namespace concave_distance {

void GeneticState::evaluate(TrialPoint& point, std::uint32_t& place) {
  point = objective.evaluate(point.node_a, point.node_b, cost);
  place = work.places.placeOf(point);
}

void GeneticState::settle(TrialPoint& point, std::uint32_t& place) {
  if (parameters.local_optimization == LocalOptimization::None) {
    point = objective.evaluate(point.node_a, point.node_b, cost);
  } else {
    const TrialPoint minimum =
        descend(objective, point, &work.basins, work.trail, cost, parameters.descent_moves);
    if (parameters.local_optimization == LocalOptimization::Lamarckian) {
      point = minimum;
    } else {
      point.squared_distance = minimum.squared_distance;
      best_below = std::min(best_below, minimum);
    }
  }
  place = work.places.placeOf(point);
}

bool GeneticState::outOfBudget() const {
  if (limit != nullptr && limit->isOver()) return true;
  return parameters.evaluation_limit != 0 && cost.evaluations >= parameters.evaluation_limit;
}

}  // namespace concave_distance
