#include "genetic_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "generation.h"
#include "mutation.h"
#include "replacement.h"
#include "search/grid/mesh_metric.h"
#include "sharing.h"

namespace concave_distance {
namespace {

/// Mesh distances that the operators need: within the largest radius. Crowding compares distances of any
/// length; it gets all of them where looking one up costs nothing.
double distanceBound(const PairObjective& objective, const GeneticParameters& parameters,
                     const NicheRadii& radii) {
  const bool has_matrices =
      objective.gridA().metric().hasMatrices() && objective.gridB().metric().hasMatrices();
  const bool within_radii = parameters.niching == NichingMethod::None ||
                            parameters.niching == NichingMethod::Sharing ||
                            parameters.niching == NichingMethod::DynamicSharing;
  return has_matrices && !within_radii ? std::numeric_limits<double>::infinity()
                                       : std::max({radii.sharing, radii.mating, radii.niche});
}

void startPopulation(GeneticState& state, const std::vector<TrialPoint>& inherited) {
  const GeneticParameters& parameters = state.parameters;
  SearchWorkspace& work = state.work;
  const std::size_t kept = std::min<std::size_t>(inherited.size(), parameters.population_size);
  work.population.assign(inherited.begin(), inherited.begin() + static_cast<std::ptrdiff_t>(kept));
  while (work.population.size() < parameters.population_size) {
    work.population.push_back(randomTrialPoint(state.objective, state.engine));
  }
  work.population_places.resize(work.population.size());
  std::size_t settled = 0;
  for (std::size_t i = 0; i < work.population.size(); ++i) {
    if (i > 0 && state.outOfBudget()) {
      // Seats that nothing is left for go to those settled already, in turn.
      work.population[i] = work.population[i - settled];
      work.population_places[i] = work.population_places[i - settled];
      continue;
    }
    if (parameters.descend_first_population) {
      state.settle(work.population[i], work.population_places[i]);
    } else {
      state.evaluate(work.population[i], work.population_places[i]);
    }
    ++settled;
  }
  state.is_descended = parameters.descend_first_population;
  state.cost.inherited += static_cast<std::uint32_t>(std::min(kept, settled));
  work.census.take(work.population_places, work.places.size());
}

void runGeneration(GeneticState& state, std::uint32_t generation) {
  SearchWorkspace& work = state.work;
  ++state.cost.generations;
  state.mutation_probability = mutationProbability(state.parameters, generation);
  state.mutation_radius = mutationRadius(state.parameters, state.objective, generation);
  chooseElites(state);
  breed(state);
  work.census.take(work.population_places, work.places.size());
  restoreElites(work.elites, work.places, work.census, work.population, work.population_places);
  admitImmigrants(state);
}

void noteBest(const GeneticState& state, std::uint32_t generation, GeneticResult& result) {
  const std::vector<TrialPoint>& population = state.work.population;
  const TrialPoint best = std::isfinite(state.best_below.squared_distance)
                              ? state.best_below
                              : *std::min_element(population.begin(), population.end());
  if (generation == 0 || best < result.best) {
    result.best = best;
    result.best_generation = generation;
  }
  result.generations = generation;
}

}  // namespace

GeneticResult geneticSearch(const PairObjective& objective, const GeneticParameters& parameters,
                            const NicheRadii& radii, const std::vector<TrialPoint>& inherited,
                            RandomEngine& engine, SearchWorkspace& workspace,
                            const GenerationObserver& observer, WorkLimit* limit, Couples couples) {
  workspace.places.reset(distanceBound(objective, parameters, radii));
  workspace.convergence.reset(parameters.convergence_generations);
  GeneticState state{objective,
                     parameters,
                     radii,
                     engine,
                     workspace,
                     limit,
                     fitnessEpsilon(parameters, objective.bodyA(), objective.bodyB()),
                     offspringCount(parameters.population_size, parameters.generation_gap),
                     couples};
  GeneticResult result;
  const auto observe = [&](std::uint32_t generation) {
    if (observer) observer({generation, &workspace.population, &result.best});
  };
  startPopulation(state, inherited);
  noteBest(state, 0, result);
  observe(0);
  for (std::uint32_t generation = 1; generation <= parameters.max_generations; ++generation) {
    runGeneration(state, generation);
    noteBest(state, generation, result);
    observe(generation);
    result.converged =
        workspace.convergence.update(workspace.census, radii.niche, workspace.places, workspace.metric);
    if (result.converged || state.outOfBudget()) break;
  }
  result.cost = state.cost;
  return result;
}

}  // namespace concave_distance
