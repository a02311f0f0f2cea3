#pragma once

#include <cstdint>

#include "base/random_engine.h"
#include "search/pair_objective.h"
#include "search/search_workspace.h"
#include "thesis/src/genetic/comb_ga.h"

namespace concave_distance {

/// The comparison of the ablation: `descents` random starts, each descended; minima in workspace.basins.
/// @param evaluation_limit no further start once this many node pairs have been evaluated; 0: no limit
GeneticResult multiStartDescent(const PairObjective& objective, std::uint32_t descents, RandomEngine& engine,
                                SearchWorkspace& workspace, std::uint64_t evaluation_limit = 0);

}  // namespace concave_distance
