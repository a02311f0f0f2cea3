#pragma once

#include <cstdint>
#include <limits>

#include "base/random_engine.h"
#include "concave_distance/base/work_limit.h"
#include "concave_distance/search/genetic_parameters.h"
#include "pair_objective.h"
#include "search_workspace.h"

namespace concave_distance {

/// Which couples of a generation mate.
enum class Couples : std::uint8_t {
  AsDrawn,     ///< those that crossover_probability draws, of parents on two places
  AtLeastOne,  ///< the same; where that leaves no child of two parents, the first couple all the same
};

/// Holds what all operators of one run of the genetic algorithm work on.
struct GeneticState {
  const PairObjective& objective;
  const GeneticParameters& parameters;
  const NicheRadii& radii;
  RandomEngine& engine;
  SearchWorkspace& work;
  WorkLimit* limit;               ///< null: none
  double epsilon;                 ///< fitnessEpsilon()
  std::uint32_t offspring_count;  ///< of a generation
  Couples couples;
  double mutation_probability = 0.0;
  double mutation_radius = 0.0;
  bool is_descended = true;  ///< the population, where individuals are descended at all
  /// This is the best of all local minima met, where individuals do not stand on them: Baldwinian only, else
  /// infinitely far.
  TrialPoint best_below{NodeIndex{}, NodeIndex{}, std::numeric_limits<double>::infinity()};
  SearchCost cost{};

  /// Computes an individual's distance where it stands, and its place.
  void evaluate(TrialPoint& point, std::uint32_t& place);
  /// The same of a new individual, with local optimisation of the local minimum below it.
  void settle(TrialPoint& point, std::uint32_t& place);
  bool outOfBudget() const;
};

}  // namespace concave_distance
