#include "genetic_search.h"

#include <algorithm>

#include "mutation.h"
#include "replacement.h"
#include "reproduction.h"

namespace concave_distance {
namespace {

/// The places that survive the next generation, into work.elites: the best, and of every niche (greedy
/// identification with sigma_n) the best as long as these take no more than half of the population: species
/// conservation (Li, Balazs, Parks and Clarkson 2002). Sampling loses niches that expect less than one.
void chooseElites(GeneticState& state) {
  SearchWorkspace& work = state.work;
  findElites(work.census, work.places, 1, work.elites);
  nichePeaks(work.census, state.radii.niche, work.places, work.metric, work.order, work.peaks);
  for (const std::uint32_t peak : work.peaks) {
    if (2 * work.elites.size() < state.parameters.population_size &&
        std::find(work.elites.begin(), work.elites.end(), peak) == work.elites.end()) {
      work.elites.push_back(peak);
    }
  }
}

void admitImmigrants(GeneticState& state) {
  SearchWorkspace& work = state.work;
  for (std::uint32_t i = 0; i < state.parameters.random_immigrants && !state.isOver(); ++i) {
    TrialPoint point = randomTrialPoint(state.objective, state.engine);
    std::uint32_t place = 0;
    state.settle(point, place);
    seatNewcomer(place, work.elites, work.places, work.census, work.population, work.population_places);
  }
}

}  // namespace

void startPopulation(GeneticState& state, const std::vector<TrialPoint>& inherited) {
  SearchWorkspace& work = state.work;
  const std::size_t size = state.parameters.population_size;
  const std::size_t kept = std::min(inherited.size(), size);
  work.places.clear();
  work.population.assign(inherited.begin(), inherited.begin() + static_cast<std::ptrdiff_t>(kept));
  while (work.population.size() < size) {
    work.population.push_back(randomTrialPoint(state.objective, state.engine));
  }
  work.population_places.resize(size);
  std::size_t settled = 0;
  for (std::size_t i = 0; i < size; ++i) {
    if (i > 0 && state.isOver()) {
      // Seats that nothing is left for go to those settled already, in turn.
      work.population[i] = work.population[i - settled];
      work.population_places[i] = work.population_places[i - settled];
      continue;
    }
    state.settle(work.population[i], work.population_places[i]);
    ++settled;
  }
  state.cost.inherited += static_cast<std::uint32_t>(std::min(kept, settled));
  work.census.take(work.population_places, work.places.size());
}

void runGeneration(GeneticState& state) {
  SearchWorkspace& work = state.work;
  ++state.cost.generations;
  chooseElites(state);
  breed(state);
  work.census.take(work.population_places, work.places.size());
  restoreElites(work.elites, work.places, work.census, work.population, work.population_places);
  admitImmigrants(state);
}

SearchCost geneticSearch(GeneticState& state, const std::vector<TrialPoint>& inherited) {
  startPopulation(state, inherited);
  while (state.cost.generations < state.parameters.max_generations) {
    runGeneration(state);
    if (state.isOver()) break;
  }
  return state.cost;
}

}  // namespace concave_distance
