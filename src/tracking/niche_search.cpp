#include "niche_search.h"

#include <algorithm>

#include "base/random_engine.h"
#include "search/automatic_radii.h"
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
// A search that finds nothing takes this part of its share.
constexpr double kLeastOfShare = 0.125;
constexpr double kMostCouples = 1e6;
// An individual costs this many evaluations besides those of its descents.
constexpr double kBookkeeping = 200.0;

/// Of a warm run that need not keep to a share.
std::uint32_t wholePopulation(std::size_t inherited, const TrackerParameters& parameters) {
  const auto wanted = static_cast<std::uint32_t>(inherited) + parameters.random_starts;
  return std::max(parameters.warm.population_size, wanted + wanted % 2);
}

}  // namespace

void NicheSearch::prepare(const BodyMesh& a, const BodyMesh& b, const TrackerParameters& parameters) {
  if (prepared_) return;
  prepared_ = true;
  // So large that a warm cycle does not have to grow them; a cold one may.
  workspace_.reserve(kUsualMinima);
  found_.reserve(kUsualMinima);
  inherited_.reserve(kUsualMinima);
  scratch_.reserve(kUsualMinima);
  cold_radii_ = automaticRadii(a, b, parameters.cold);
  warm_radii_ = automaticRadii(a, b, parameters.warm);
}

void NicheSearch::begin(const BodyMesh& a, const BodyMesh& b, const TrackerParameters& parameters) {
  prepare(a, b, parameters);
  workspace_.basins.clear();
}

TrialPoint NicheSearch::descendKnown(const PairFrame& frame, const TrialPoint& pair, SearchCost& cost) {
  const PairObjective objective(frame.a, frame.b, frame.a_from_b);
  return descend(objective, objective.evaluate(pair.node_a, pair.node_b, cost), &workspace_.basins,
                 workspace_.trail, cost);
}

const std::vector<TrialPoint>& NicheSearch::propose(const PairFrame& frame,
                                                    const TrackerParameters& parameters,
                                                    const std::vector<TrialPoint>& known, const Run& run,
                                                    SearchCost& cost, WorkLimit& limit) {
  const PairObjective objective(frame.a, frame.b, frame.a_from_b);
  const std::size_t known_minima = workspace_.basins.minima().size();
  RandomEngine engine(streamSeed(parameters.seed, run.pair, run.cycle));
  inherited_.clear();
  const bool as_warm = run.warm || run.is_helper;
  GeneticParameters genetic = as_warm ? parameters.warm : parameters.cold;
  if (run.warm) {
    const std::uint32_t limit_of_inherited =
        run.population > 0 ? inheritedOf(run.population, parameters) : parameters.inherited_limit;
    inherit(known, {parameters.inherited_per_niche, limit_of_inherited}, fitnessEpsilon(frame.a, frame.b),
            inherited_, scratch_);
    genetic.population_size =
        run.population > 0 ? run.population : wholePopulation(inherited_.size(), parameters);
  }
  GeneticState state(objective, genetic, radii(as_warm), engine, workspace_, &limit,
                     run.breeds ? Couples::AtLeastOne : Couples::AsDrawn);
  const SearchCost spent = geneticSearch(state, inherited_);
  cost += spent;
  const std::vector<TrialPoint>& minima = workspace_.basins.minima();
  found_.assign(minima.begin() + static_cast<std::ptrdiff_t>(known_minima), minima.end());
  std::sort(found_.begin(), found_.end());
  if (run.warm && found_.size() > kWarmProposals) found_.resize(kWarmProposals);
  if (!run.warm) workspace_.shrink();
  last_population_ = genetic.population_size;
  last_cost_ = static_cast<double>(spent.evaluations) + kBookkeeping * last_population_;
  return found_;
}

std::uint32_t NicheSearch::helpersPopulation(std::size_t niche_count,
                                             const TrackerParameters& parameters) const {
  const double copies = parameters.inherited_per_niche * static_cast<double>(niche_count);
  const double inherited = std::min<double>(copies, parameters.inherited_limit);
  return std::min(2 * couples_, wholePopulation(static_cast<std::size_t>(inherited), parameters));
}

std::uint32_t NicheSearch::inheritedOf(std::uint32_t population, const TrackerParameters& parameters) {
  return population - std::min(parameters.random_starts, population / 4);
}

void NicheSearch::earn(std::size_t found, double work, double share) {
  if (last_population_ == 0) return;
  const std::uint32_t last_couples = last_population_ / 2;
  const double wanted = found > 0 ? 2.0 * last_couples : last_couples - 1.0;
  const double affordable = share * work * last_couples / last_cost_;
  const double couples = std::clamp(wanted, kLeastOfShare * affordable, std::max(1.0, affordable));
  couples_ = static_cast<std::uint32_t>(std::clamp(couples, 1.0, kMostCouples));
  last_population_ = 0;
}

}  // namespace concave_distance
