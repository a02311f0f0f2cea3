#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "base/random_engine.h"
#include "comb_ga_parameters.h"
#include "dynamic_sharing.h"
#include "search/mating.h"
#include "search/pair_objective.h"
#include "search/search_workspace.h"

namespace concave_distance {

/// Holds a run of comb-GA and runs its steps, in all variants.
class CombGaState {
 public:
  /// @param parameters validated; what is given by reference has to outlive the run
  CombGaState(const PairObjective& objective, const CombGaParameters& parameters, const NicheRadii& radii,
              RandomEngine& engine, SearchWorkspace& work);

  /// Fills the population: those inherited, then random individuals, all settled as far as the budget goes.
  void startPopulation(const std::vector<TrialPoint>& inherited);
  /// Runs one generation in the block order of Carretero, fig. 4.3, 4.4. The elites of the last one and its
  /// niches, where they are conserved, survive; immigrants take seats where nobody stands yet.
  void runGeneration();
  bool outOfBudget() const;

  const std::vector<TrialPoint>& population() const { return work_.population; }
  const SearchCost& cost() const { return cost_; }
  /// This is the best of all local minima met, where individuals do not stand on them: Baldwinian only, else
  /// infinitely far.
  const TrialPoint& bestBelow() const { return best_below_; }

 private:
  void evaluate(TrialPoint& point, std::uint32_t& place);
  void settle(TrialPoint& point, std::uint32_t& place);
  void chooseElites();
  void countNiches();
  void weigh();
  void selectParents();
  void pairUp();
  bool mayMate(std::size_t i);
  Children mateCouple(const TrialPoint& parent_1, const TrialPoint& parent_2);
  void mateCouples();
  void competeBeforeDescent(bool parents_are_new);
  void mutateOffspring();
  void settleOffspring();
  void takeSeats(const std::vector<std::uint32_t>& seats);
  void seatOffspring();
  void breed();
  void admitImmigrants();

  const PairObjective& objective_;
  const CombGaParameters& parameters_;
  const NicheRadii& radii_;
  RandomEngine& engine_;
  SearchWorkspace& work_;
  double epsilon_;                 ///< of the potential fitness, metres
  std::uint32_t offspring_count_;  ///< of a generation
  SearchCost cost_{};
  TrialPoint best_below_{NodeIndex{}, NodeIndex{}, std::numeric_limits<double>::infinity()};
  std::vector<double> wheel_;
  std::vector<std::uint32_t> seats_;
  DynamicNicheBuffers niches_;
};

}  // namespace concave_distance
