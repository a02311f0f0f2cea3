#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/random_engine.h"
#include "comb_ga_parameters.h"
#include "search/pair_objective.h"
#include "search/search_workspace.h"

namespace concave_distance {

/// Watches a run, for figures and tables; called after each generation (0 is the initial population).
struct GenerationRecord {
  std::uint32_t generation;
  const std::vector<TrialPoint>* population;
  const TrialPoint* best_so_far;
};

using GenerationObserver = std::function<void(const GenerationRecord&)>;

struct GeneticResult {
  TrialPoint best;
  std::uint32_t best_generation = 0;  ///< G_i: the generation in which the run's best appeared
  std::uint32_t generations = 0;      ///< run, without the initial one
  bool converged = false;             ///< stopped early by the convergence criterion
  SearchCost cost;
};

/// Runs comb-GA (Carretero, ch. 3 and 4) in any of its variants; block order of fig. 4.3 (sharing between
/// evaluation and selection) or fig. 4.4 (crowding between mating and mutation). Initial population,
/// final one and minima as of geneticSearch(), which this is with the default parameters. Never throws.
/// @param parameters validated
/// @param radii from automaticRadii()
/// @param observer called once a generation when not empty
GeneticResult combGa(const PairObjective& objective, const CombGaParameters& parameters,
                     const NicheRadii& radii, const std::vector<TrialPoint>& inherited, RandomEngine& engine,
                     SearchWorkspace& workspace, const GenerationObserver& observer = {});

}  // namespace concave_distance
