#pragma once

#include <vector>

#include "genetic_state.h"

namespace concave_distance {

/// Fills the population: those inherited, then random individuals, all settled as far as the budget goes.
void startPopulation(GeneticState& state, const std::vector<TrialPoint>& inherited);
/// Runs one generation. The best of the last one and of each of its niches survive; random immigrants take
/// seats where nobody stands yet.
void runGeneration(GeneticState& state);

/// Runs comb-GA (Carretero, ch. 3 and 4): initial population = `inherited`, the rest random; block order of
/// fig. 4.3 (sharing between evaluation and selection). The final population stays in workspace.population.
/// Every local minimum met is added to workspace.basins (its minima() are the archive's food), which the
/// caller clears once a cycle: basins descended before the call are not descended again. Allocates only while
/// the workspace warms up. Never throws.
/// @param inherited node pairs to start from, evaluated and descended anew; what exceeds the population is
///        left out
SearchCost geneticSearch(GeneticState& state, const std::vector<TrialPoint>& inherited);

}  // namespace concave_distance
