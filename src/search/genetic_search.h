#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/random_engine.h"
#include "concave_distance/base/work_limit.h"
#include "concave_distance/search/genetic_parameters.h"
#include "genetic_state.h"
#include "pair_objective.h"
#include "search_workspace.h"

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

/// comb-GA (Carretero, ch. 3 and 4): initial population = `inherited`, the rest random; block order of fig.
/// 4.3 (sharing between evaluation and selection) or fig. 4.4 (crowding between mating and mutation; children
/// are descended before they compete). The final population stays in workspace.population. With local
/// optimisation every local minimum met is added to workspace.basins (its minima() are the archive's food),
/// which the caller clears once a cycle: basins descended before the call are not descended again.
/// @param parameters validated
/// @param radii from automaticRadii()
/// @param inherited node pairs to start from, evaluated and descended anew; what exceeds the population is
///        left out
/// @param limit ends the run with its results so far, once one individual is settled; nullptr: none
/// @param couples AtLeastOne: every generation has a child of two parents, also one that the limit cuts short
/// @param observer called once a generation when not empty; the only call that may allocate in a warm run
/// Otherwise allocates only while the workspace warms up. Never throws.
GeneticResult geneticSearch(const PairObjective& objective, const GeneticParameters& parameters,
                            const NicheRadii& radii, const std::vector<TrialPoint>& inherited,
                            RandomEngine& engine, SearchWorkspace& workspace,
                            const GenerationObserver& observer = {}, WorkLimit* limit = nullptr,
                            Couples couples = Couples::AsDrawn);

}  // namespace concave_distance
