#include "niche_search.h"

#include <algorithm>

#include "base/random_engine.h"
#include "search/genetic_search.h"
#include "search/local_descent.h"
#include "search/pair_objective.h"
#include "search/sharing.h"
#include "warm_start.h"

namespace concave_distance {
namespace {

// Usual maximum of a warm cycle; buffers grow beyond it.
constexpr std::size_t kUsualMinima = 1024;
// Node pairs that a warm run may propose, the best first; a cold one proposes them all.
constexpr std::size_t kWarmProposals = 64;
// A share is saved up for this many runs, at most.
constexpr double kMostRunsSaved = 4.0;

}  // namespace

void NicheSearch::prepare(const PairGeometry& geometry, const TrackerParameters& parameters) {
  if (prepared_) return;
  prepared_ = true;
  // So large that a warm cycle does not have to grow them; a cold one may.
  workspace_.reserve(kUsualMinima);
  found_.reserve(kUsualMinima);
  inherited_.reserve(kUsualMinima);
  scratch_.reserve(kUsualMinima);
  cold_radii_ = automaticRadii(*geometry.a, *geometry.b, parameters.cold);
  warm_radii_ = automaticRadii(*geometry.a, *geometry.b, parameters.warm);
}

void NicheSearch::begin(const PairGeometry& geometry, const TrackerParameters& parameters) {
  prepare(geometry, parameters);
  workspace_.basins.clear();
}

TrialPoint NicheSearch::descendKnown(const PairGeometry& geometry, const TrialPoint& pair, SearchCost& cost) {
  const PairObjective objective(*geometry.a, *geometry.b, geometry.a_from_b);
  return descend(objective, objective.evaluate(pair.node_a, pair.node_b, cost), &workspace_.basins,
                 workspace_.trail, cost);
}

const std::vector<TrialPoint>& NicheSearch::propose(const PairGeometry& geometry,
                                                    const TrackerParameters& parameters,
                                                    const std::vector<TrialPoint>& known, const Run& run,
                                                    SearchCost& cost, WorkLimit& limit) {
  const PairObjective objective(*geometry.a, *geometry.b, geometry.a_from_b);
  const std::uint64_t before = cost.evaluations;
  const std::size_t known_minima = workspace_.basins.minima().size();
  RandomEngine engine(streamSeed(parameters.seed, run.pair, run.cycle));
  inherited_.clear();
  const bool as_warm = run.warm || run.is_helper;
  GeneticParameters genetic = as_warm ? parameters.warm : parameters.cold;
  if (run.warm) {
    inherit(known, {parameters.inherited_per_niche, parameters.inherited_limit},
            fitnessEpsilon(genetic, *geometry.a, *geometry.b), inherited_, scratch_);
    const auto wanted = static_cast<std::uint32_t>(inherited_.size()) + parameters.random_starts;
    genetic.population_size = std::max(genetic.population_size, wanted + wanted % 2);
  }
  const GeneticResult result =
      geneticSearch(objective, genetic, radii(as_warm), inherited_, engine, workspace_, {}, &limit);
  cost.evaluations += result.cost.evaluations;
  cost.descents += result.cost.descents;
  cost.descents_joined += result.cost.descents_joined;
  cost.descent_steps += result.cost.descent_steps;
  if (genetic.local_optimization == LocalOptimization::None) workspace_.basins.addMinimum(result.best);
  const std::vector<TrialPoint>& minima = workspace_.basins.minima();
  found_.assign(minima.begin() + static_cast<std::ptrdiff_t>(known_minima), minima.end());
  std::sort(found_.begin(), found_.end());
  if (run.warm && found_.size() > kWarmProposals) found_.resize(kWarmProposals);
  if (!run.warm) workspace_.shrink();
  run_cost_ = static_cast<double>(cost.evaluations - before);
  credit_ -= run_cost_;
  return found_;
}

void NicheSearch::earn(double work, double share) {
  credit_ = std::min(credit_ + share * work, kMostRunsSaved * run_cost_);
}

std::size_t NicheSearch::memoryBytes() const {
  return workspace_.memoryBytes() + (inherited_.capacity() + found_.capacity()) * sizeof(TrialPoint) +
         scratch_.capacity() * sizeof(double);
}

}  // namespace concave_distance
