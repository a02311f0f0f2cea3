#include "genetic_search.h"

#include "generation.h"

namespace concave_distance {

SearchCost geneticSearch(GeneticState& state, const std::vector<TrialPoint>& inherited) {
  startPopulation(state, inherited);
  while (state.cost.generations < state.parameters.max_generations) {
    runGeneration(state);
    if (state.outOfBudget()) break;
  }
  return state.cost;
}

}  // namespace concave_distance
