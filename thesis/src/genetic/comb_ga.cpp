#include "comb_ga.h"

#include <algorithm>
#include <cmath>

#include "comb_ga_state.h"
#include "convergence.h"

namespace concave_distance {
namespace {

void noteBest(const CombGaState& state, GeneticResult& result) {
  const std::vector<TrialPoint>& population = state.population();
  const TrialPoint best = std::isfinite(state.bestBelow().squared_distance)
                              ? state.bestBelow()
                              : *std::min_element(population.begin(), population.end());
  result.generations = state.cost().generations;
  if (result.generations == 0 || best < result.best) {
    result.best = best;
    result.best_generation = result.generations;
  }
}

}  // namespace

GeneticResult combGa(const PairObjective& objective, const CombGaParameters& parameters,
                     const NicheRadii& radii, const std::vector<TrialPoint>& inherited, RandomEngine& engine,
                     SearchWorkspace& workspace, const GenerationObserver& observer) {
  CombGaState state(objective, parameters, radii, engine, workspace);
  ConvergenceCheck convergence;
  convergence.reset(parameters.convergence_generations);
  GeneticResult result;
  const auto note = [&] {
    noteBest(state, result);
    if (observer) observer({result.generations, &workspace.population, &result.best});
  };
  state.startPopulation(inherited);
  note();
  while (result.generations < parameters.max_generations) {
    state.runGeneration();
    note();
    result.converged = convergence.update(workspace.census, radii.niche, workspace.places, workspace.metric);
    if (result.converged || state.outOfBudget()) break;
  }
  result.cost = state.cost();
  return result;
}

}  // namespace concave_distance
