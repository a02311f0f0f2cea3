#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "comb_ga_parameters.h"
#include "dynamic_sharing.h"
#include "search/genetic_state.h"

namespace concave_distance {

/// Runs the steps of comb-GA in all its variants, where the core has one.
struct CombGaState : GeneticState {
  /// @param core its parameters are partOfCore(parameters)
  /// @param parameters validated; have to outlive the run
  CombGaState(const GeneticState& core, const CombGaParameters& parameters);

  void settle(TrialPoint& point, std::uint32_t& place) override;
  bool mayMate(std::size_t i) override;
  Children mate(const TrialPoint& parent_1, const TrialPoint& parent_2) override;
  /// Block order of Carretero, fig. 4.3, 4.4.
  void breed() override;

  /// This is the best of all local minima met, where individuals do not stand on them: Baldwinian only, else
  /// infinitely far.
  TrialPoint best_below{NodeIndex{}, NodeIndex{}, std::numeric_limits<double>::infinity()};

 private:
  void evaluate(TrialPoint& point, std::uint32_t& place);
  void countNiches();
  void selectByScheme();
  void restrictByScheme();
  void competeBeforeDescent(bool parents_are_new);
  void mutateByMethod();
  void seatByScheme();

  const CombGaParameters& all_;
  std::uint32_t offspring_count_;  ///< of a generation
  std::vector<double> wheel_;
  std::vector<std::uint32_t> seats_;
  DynamicNicheBuffers niches_;
};

}  // namespace concave_distance
