#include "comb_ga.h"

#include <algorithm>
#include <cmath>

#include "comb_ga_state.h"
#include "convergence.h"
#include "search/genetic_search.h"

namespace concave_distance {
namespace {

void noteBest(const CombGaState& state, GeneticResult& result) {
  const std::vector<TrialPoint>& population = state.work.population;
  const TrialPoint best = std::isfinite(state.best_below.squared_distance)
                              ? state.best_below
                              : *std::min_element(population.begin(), population.end());
  result.generations = state.cost.generations;
  if (result.generations == 0 || best < result.best) {
    result.best = best;
    result.best_generation = result.generations;
  }
}

}  // namespace

GeneticResult combGa(const PairObjective& objective, const CombGaParameters& parameters,
                     const NicheRadii& radii, const std::vector<TrialPoint>& inherited, RandomEngine& engine,
                     SearchWorkspace& workspace, const GenerationObserver& observer, WorkLimit* limit,
                     Couples couples) {
  const GeneticParameters core = partOfCore(parameters);
  CombGaState state(GeneticState(objective, core, radii, engine, workspace, limit, couples), parameters);
  ConvergenceCheck convergence;
  convergence.reset(parameters.convergence_generations);
  GeneticResult result;
  const auto note = [&] {
    noteBest(state, result);
    if (observer) observer({result.generations, &workspace.population, &result.best});
  };
  startPopulation(state, inherited);
  note();
  while (result.generations < parameters.max_generations) {
    runGeneration(state);
    note();
    result.converged = convergence.update(workspace.census, radii.niche, workspace.places, workspace.metric);
    if (result.converged || state.outOfBudget()) break;
  }
  result.cost = state.cost;
  return result;
}

}  // namespace concave_distance
