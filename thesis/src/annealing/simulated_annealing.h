#pragma once

#include <cstdint>
#include <functional>

#include "annealing_parameters.h"
#include "base/random_engine.h"
#include "search/pair_objective.h"
#include "search/search_workspace.h"

namespace concave_distance {

/// One iteration of a run, for figures and tables.
struct AnnealingRecord {
  std::uint32_t iteration;  ///< 0: the initial trial point
  /// p_b of eq. (2.6) at this iteration's trial point, at most 1.
  double acceptance_probability;
  const TrialPoint* current;
  const TrialPoint* best_so_far;
};

using AnnealingObserver = std::function<void(const AnnealingRecord&)>;

struct AnnealingResult {
  TrialPoint best;
  std::uint32_t best_iteration = 0;  ///< in which the run's best appeared
  std::uint32_t iterations = 0;      ///< run, without the initial point
  SearchCost cost;
};

/// p_b = exp((f_before - f_now) / (k_B t)) (Carretero, eq. (2.6)), 1 where nothing got worse or the exponent
/// has no value (t or k_B of 0 and no change). Squared distances, square metres.
double acceptanceProbability(double squared_before, double squared_now, double boltzmann_constant,
                             double temperature);

/// comb-SA (Carretero, fig. 2.9, sec. 3.2): one trial point moves at random, is descended where local
/// optimisation is on, and is kept when it is no worse than the last one or else with probability p_b. The
/// best one met is the result. Local minima met are added to workspace.basins, which the caller clears.
/// @param parameters validated
/// @param observer called once an iteration when not empty
/// Allocates only while the workspace warms up. Never throws.
AnnealingResult simulatedAnnealing(const PairObjective& objective, const AnnealingParameters& parameters,
                                   RandomEngine& engine, SearchWorkspace& workspace,
                                   const AnnealingObserver& observer = {});

}  // namespace concave_distance
