#pragma once

#include <cstddef>
#include <cstdint>

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
  /// @param parameters validated; what is given by reference has to outlive the run
  /// @param limit ends the run with its results so far, once one individual is settled; nullptr: none
  GeneticState(const PairObjective& objective, const GeneticParameters& parameters, const NicheRadii& radii,
               RandomEngine& engine, SearchWorkspace& work, WorkLimit* limit = nullptr,
               Couples couples = Couples::AsDrawn);

  const PairObjective& objective;
  const GeneticParameters& parameters;
  const NicheRadii& radii;
  RandomEngine& engine;
  SearchWorkspace& work;
  WorkLimit* limit;  ///< null: none
  Couples couples;
  double epsilon;  ///< fitnessEpsilon(), metres
  SearchCost cost{};

  /// Moves a new individual to the local minimum below it, and finds its place.
  void settle(TrialPoint& point, std::uint32_t& place);
  bool isOver() const { return limit != nullptr && limit->isOver(); }
};

}  // namespace concave_distance
