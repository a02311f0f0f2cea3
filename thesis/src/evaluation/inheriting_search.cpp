#include "inheriting_search.h"

#include <algorithm>

#include "search/automatic_radii.h"
#include "search/pair_objective.h"
#include "search/sharing.h"

namespace concave_distance::evaluation {
namespace {

std::uint32_t islandCount(const SearchMethod& method) {
  const auto* islands = std::get_if<IslandParameters>(&method);
  return islands != nullptr ? islands->islands : 1;
}

CombGaParameters& geneticIn(SearchMethod& method) {
  auto* islands = std::get_if<IslandParameters>(&method);
  return islands != nullptr ? islands->genetic : std::get<CombGaParameters>(method);
}

}  // namespace

const CombGaParameters* geneticOf(const SearchMethod& method) {
  if (const auto* islands = std::get_if<IslandParameters>(&method)) return &islands->genetic;
  return std::get_if<CombGaParameters>(&method);
}

const CombGaParameters& InheritingSearch::Step::genetic() const {
  return *geneticOf(method);
}

InheritingSearch::InheritingSearch(const SearchMethod& first, const SearchMethod& further,
                                   const FirstGuess& guess, const BodyMesh& a, const BodyMesh& b,
                                   std::uint64_t seed, SearchWorkspace& workspace)
    : first_{first, automaticRadii(a, b, *geneticOf(first))},
      further_{further, automaticRadii(a, b, *geneticOf(further))},
      guess_(guess),
      a_(&a),
      b_(&b),
      engine_(seed),
      workspace_(&workspace),
      islands_(a, b, std::max(islandCount(first), islandCount(further)), workspace),
      motion_(a, b, guess.extrapolation) {}

GeneticResult InheritingSearch::run(const PairObjective& objective, Step& step) {
  if (guess_.random_starts && !is_first_) {
    CombGaParameters& genetic = geneticIn(step.method);
    const auto wanted = static_cast<std::uint32_t>(inherited_.size()) + *guess_.random_starts;
    const std::uint32_t usual = further_.genetic().population_size;
    genetic.population_size = std::max(usual, wanted + wanted % 2);
  }
  if (const auto* islands = std::get_if<IslandParameters>(&step.method)) {
    return islandSearch(objective, *islands, step.radii, inherited_, engine_, islands_.all()).genetic;
  }
  return combGa(objective, step.genetic(), step.radii, inherited_, engine_, *workspace_);
}

GeneticResult InheritingSearch::search(const Eigen::Isometry3d& a_from_b) {
  const PairObjective objective(*a_, *b_, a_from_b);
  islands_.clearBasins();
  Step step = is_first_ ? first_ : further_;
  const GeneticResult result = run(objective, step);
  is_first_ = false;
  identifyNiches(workspace_->population, step.radii.niche, workspace_->metric, niches_, workspace_->order);
  known_.clear();
  for (const IdentifiedNiche& niche : niches_) known_.push_back(niche.best);
  motion_.extrapolate(further_.radii.niche, workspace_->metric, known_);
  handOn(further_);
  return result;
}

void InheritingSearch::handOn(const Step& next) {
  if (guess_.fixed_per_niche) {
    inheritFixedCount(known_, *guess_.fixed_per_niche, inherited_);
  } else {
    inherit(known_, guess_.inheritance, next.genetic().fitness_epsilon * fitnessEpsilon(*a_, *b_), inherited_,
            scratch_);
  }
}

}  // namespace concave_distance::evaluation
