#pragma once

#include <vector>

#include "genetic_state.h"

namespace concave_distance {

/// Fills the population: those inherited, then random individuals, all settled as far as the budget goes.
void startPopulation(GeneticState& state, const std::vector<TrialPoint>& inherited);
/// Runs one generation. The elites of the last one and its niches, where they are conserved, survive; random
/// immigrants take seats where nobody stands yet.
void runGeneration(GeneticState& state);

}  // namespace concave_distance
