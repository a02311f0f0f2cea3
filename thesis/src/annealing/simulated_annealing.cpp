#include "simulated_annealing.h"

#include <algorithm>
#include <cmath>

#include "base/parameter_checks.h"
#include "search/mutation.h"
#include "thesis/src/genetic/mutation_methods.h"

namespace concave_distance {

void AnnealingParameters::validate(const std::string& where) const {
  if (initial_temperature == 0) detail::refuse(where, "initial_temperature", "0", "1 or more");
  detail::requireNotNegative(where, "boltzmann_constant", boltzmann_constant);
  detail::requireLength(where, "move_radius", move_radius);
  detail::requireShare(where, "new_point_probability", new_point_probability);
}

double acceptanceProbability(double squared_before, double squared_now, double boltzmann_constant,
                             double temperature) {
  if (squared_now <= squared_before) return 1.0;
  return std::exp((squared_before - squared_now) / (boltzmann_constant * temperature));
}

AnnealingResult simulatedAnnealing(const PairObjective& objective, const AnnealingParameters& parameters,
                                   RandomEngine& engine, SearchWorkspace& workspace,
                                   const AnnealingObserver& observer) {
  AnnealingResult result;
  const auto settle = [&](const TrialPoint& point) {
    return parameters.local_optimization ? descendBy(parameters.descent_moves, objective, point,
                                                     &workspace.basins, workspace.trail, result.cost)
                                         : objective.evaluate(point.node_a, point.node_b, result.cost);
  };
  const double radius = parameters.move_radius.value_or(
      std::max(objective.gridA().geodesicExtent(), objective.gridB().geodesicExtent()));
  TrialPoint current = settle(randomTrialPoint(objective, engine));
  result.best = current;
  double probability = 1.0;
  if (observer) observer({0, probability, &current, &result.best});
  for (std::uint32_t temperature = parameters.initial_temperature; temperature > 0; --temperature) {
    if (parameters.evaluation_limit != 0 && result.cost.evaluations >= parameters.evaluation_limit) break;
    ++result.iterations;
    const double scale = parameters.variable_displacement ? probability : 1.0;
    const TrialPoint next = settle(parameters.move == AnnealingMove::NewPoint ||
                                           uniformUnit(engine) < parameters.new_point_probability
                                       ? randomTrialPoint(objective, engine)
                                       : moveBoth(current, scale * radius, workspace.metric, engine));
    probability = acceptanceProbability(current.squared_distance, next.squared_distance,
                                        parameters.boltzmann_constant, temperature);
    if (probability >= 1.0 || uniformUnit(engine) < probability) current = next;
    if (current < result.best) {
      result.best = current;
      result.best_iteration = result.iterations;
    }
    if (observer) observer({result.iterations, probability, &current, &result.best});
  }
  return result;
}

}  // namespace concave_distance
