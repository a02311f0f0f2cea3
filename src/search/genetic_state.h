#pragma once

#include <cstddef>
#include <cstdint>

#include "base/random_engine.h"
#include "concave_distance/base/work_limit.h"
#include "concave_distance/search/genetic_parameters.h"
#include "mating.h"
#include "pair_objective.h"
#include "search_workspace.h"

namespace concave_distance {

/// Which couples of a generation mate.
enum class Couples : std::uint8_t {
  AsDrawn,     ///< those that crossover_probability draws, of parents on two places
  AtLeastOne,  ///< the same; where that leaves no child of two parents, the first couple all the same
};

/// Holds what all operators of one run of the genetic algorithm work on. Its virtual functions are the steps
/// that experiments replace (thesis/src/genetic).
struct GeneticState {
  /// @param parameters validated; what is given by reference has to outlive the run
  /// @param limit ends the run with its results so far, once one individual is settled; nullptr: none
  GeneticState(const PairObjective& objective, const GeneticParameters& parameters, const NicheRadii& radii,
               RandomEngine& engine, SearchWorkspace& work, WorkLimit* limit = nullptr,
               Couples couples = Couples::AsDrawn);
  GeneticState(const GeneticState&) = default;
  virtual ~GeneticState() = default;

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
  virtual void settle(TrialPoint& point, std::uint32_t& place);
  /// Returns whether the couple of work.offspring i and i + 1 may have children.
  virtual bool mayMate(std::size_t /*i*/) { return true; }
  /// Returns the children that stand between these parents.
  virtual Children mate(const TrialPoint& parent_1, const TrialPoint& parent_2);
  /// Replaces the population by the next one: parents, children and who of them takes which seat, in the
  /// block order of the method of niching (Carretero, fig. 4.3).
  virtual void breed();

  bool outOfBudget() const;
};

}  // namespace concave_distance
