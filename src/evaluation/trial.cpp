#include "trial.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>

#include "concave_distance/continuous/continuous_annealing.h"
#include "concave_distance/continuous/continuous_genetic_search.h"
#include "concave_distance/search/automatic_radii.h"
#include "concave_distance/search/niche_identification.h"

namespace concave_distance::evaluation {
namespace {

using Clock = std::chrono::steady_clock;

/// Distances are sums of squares rounded alike; two node pairs are as good when only rounding parts them.
constexpr double kSame = 1.0 + 1e-12;
constexpr std::uint64_t kFlopsOfAPair = 26;

NicheRadii radiiOf(const SceneTruth& scene, const SearchMethod& method) {
  const auto* genetic = std::get_if<GeneticParameters>(&method);
  return automaticRadii(*scene.a, *scene.b, genetic != nullptr ? *genetic : GeneticParameters());
}

/// What one generation or iteration shows.
struct Moment {
  std::uint32_t iteration;
  double best_square;  ///< objective of the best so far, square metres
  double mean_square;
  double niches;
  double acceptance;
};

/// Adds up what a run shows on its way, and the time that looking takes.
class Diary {
 public:
  Diary(std::uint32_t stride, std::vector<CurvePoint>* curve) : stride_(stride), curve_(curve) {}

  bool keeps(std::uint32_t iteration) const { return curve_ != nullptr && iteration % stride_ == 0; }
  void startLooking() { start_ = Clock::now(); }
  void note(const Moment& moment) {
    if (moment.iteration > 0) {
      best_sum_ += moment.best_square;
      mean_sum_ += moment.mean_square;
      ++count_;
    }
    if (keeps(moment.iteration)) {
      const std::size_t place = moment.iteration / stride_;
      if (curve_->size() <= place) curve_->resize(place + 1);
      CurvePoint& point = (*curve_)[place];
      point.best_distance += std::sqrt(moment.best_square);
      point.mean_square += moment.mean_square;
      point.niches += moment.niches;
      point.acceptance += moment.acceptance;
    }
    microseconds_ += std::chrono::duration<double, std::micro>(Clock::now() - start_).count();
  }

  /// Over the optimum's objective, square metres (5.1), (5.2).
  void conclude(Clock::time_point start, double optimum, TrialRecord& record) const {
    record.microseconds =
        std::chrono::duration<double, std::micro>(Clock::now() - start).count() - microseconds_;
    if (count_ == 0.0) return;
    record.best_convergence = best_sum_ / count_ / optimum;
    record.population_convergence = mean_sum_ / count_ / optimum;
  }

 private:
  std::uint32_t stride_;
  std::vector<CurvePoint>* curve_;
  Clock::time_point start_;
  double best_sum_ = 0.0;
  double mean_sum_ = 0.0;
  double count_ = 0.0;
  double microseconds_ = 0.0;
};

double share(std::size_t part, std::size_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 1.0;
}

/// Which true niches the final population's and all minima met are, decided by the flood that made the truth.
void measureRecall(const SceneTruth& scene, const std::vector<IdentifiedNiche>& found,
                   const std::vector<TrialPoint>& archive, TrialRecord& record) {
  LocalMinimaRequest request;
  request.cutoff = scene.niche_cutoff;
  const auto ask = [&](const TrialPoint& place) {
    request.whose.emplace_back(scene.a->originalTriangle(place.node_a),
                               scene.b->originalTriangle(place.node_b));
  };
  for (const IdentifiedNiche& niche : found) ask(niche.best);
  for (const TrialPoint& place : archive) ask(place);
  const LocalMinima truth = findLocalMinima(*scene.a, *scene.b, scene.a_from_b, request);
  const auto archive_begin = truth.owners.begin() + static_cast<std::ptrdiff_t>(found.size());
  const auto count_met = [](auto begin, auto end) {
    std::set<std::size_t> met(begin, end);
    met.erase(LocalMinima::kNoOwner);
    return met.size();
  };
  const std::size_t met = count_met(truth.owners.begin(), archive_begin);
  record.recall = share(met, truth.niches.size());
  record.precision = share(met, found.size());
  record.archive_recall = share(count_met(archive_begin, truth.owners.end()), truth.niches.size());
}

TrialRecord runCombinatorial(const SearchMethod& method, const SceneTruth& scene, bool with_recall,
                             RandomEngine& engine, SearchWorkspace& workspace, Diary& diary) {
  const NicheRadii radii = radiiOf(scene, method);
  const PairObjective objective(*scene.a, *scene.b, scene.a_from_b);
  std::vector<TrialPoint> population;
  std::vector<IdentifiedNiche> seen;
  std::vector<std::uint32_t> order;
  const auto look = [&](const SearchRecord& record) {
    diary.startLooking();
    double sum = 0.0;
    for (std::size_t i = 0; i < record.point_count; ++i) sum += record.points[i].squared_distance;
    if (diary.keeps(record.iteration) && record.point_count > 1) {
      population.assign(record.points, record.points + record.point_count);
      identifyNiches(population, radii.niche, workspace.metric, seen, order);
    }
    diary.note({record.iteration, record.best_so_far->squared_distance,
                sum / static_cast<double>(record.point_count), static_cast<double>(seen.size()),
                record.acceptance_probability});
  };
  workspace.basins.clear();
  const Clock::time_point start = Clock::now();
  const SearchOutcome outcome = searchPair(objective, method, radii, engine, workspace, look);
  TrialRecord record;
  diary.conclude(start, scene.node_distance * scene.node_distance, record);
  record.distance = std::sqrt(outcome.best.squared_distance);
  record.best_iteration = outcome.best_iteration;
  record.exact = record.distance <= scene.node_distance * kSame;
  record.region = record.exact || record.distance < scene.region_limit;
  record.below_second = record.distance < scene.second_distance;
  record.cost = outcome.cost;
  record.flops = kFlopsOfAPair * outcome.cost.evaluations;
  std::vector<IdentifiedNiche>& niches = workspace.niches;
  identifyNiches(workspace.population, radii.niche, workspace.metric, niches, workspace.order);
  record.niches = static_cast<std::uint32_t>(niches.size());
  for (std::size_t i = 0; i < std::min(niches.size(), record.members.size()); ++i) {
    record.members[i] = niches[i].member_count;
    record.niche_distances[i] = std::sqrt(niches[i].best.squared_distance);
  }
  if (with_recall) measureRecall(scene, niches, workspace.basins.minima(), record);
  return record;
}

/// @param search what runs, given an observer
template <typename Search>
TrialRecord runContinuous(const SceneTruth& scene, Diary& diary, const Search& search) {
  const auto look = [&diary](const ContinuousRecord& record) {
    diary.startLooking();
    double sum = 0.0;
    for (const ContinuousPoint& point : *record.population) sum += point.objective;
    diary.note({record.generation, record.best_so_far->objective,
                sum / static_cast<double>(record.population->size()), 0.0, record.boltzmann_factor});
  };
  const Clock::time_point start = Clock::now();
  const ContinuousResult result = search(look);
  TrialRecord record;
  diary.conclude(start, scene.exact_distance * scene.exact_distance, record);
  record.distance = result.distance;
  record.best_iteration = result.best_generation;
  record.feasible = result.is_feasible;
  record.exact = record.feasible && record.distance <= scene.exact_distance * kSame;
  record.region = record.feasible && record.distance < scene.exact_region_limit;
  record.below_second = record.distance < scene.second_distance;
  record.cost.evaluations = result.cost.evaluations;
  record.cost.descent_steps = result.cost.local_steps;
  record.flops = result.cost.flops();
  return record;
}

}  // namespace

std::uint32_t curveStride(const Method& method) {
  const auto* search = std::get_if<SearchMethod>(&method);
  const bool anneals = search != nullptr ? std::holds_alternative<AnnealingParameters>(*search)
                                         : std::holds_alternative<ContinuousAnnealingParameters>(method);
  return anneals ? 10 : 1;
}

TrialRecord runTrial(const Experiment& experiment, const ExperimentRow& row, const SceneTruth& scene,
                     std::uint32_t run, SearchWorkspace& workspace, std::vector<CurvePoint>* curve) {
  Diary diary(curveStride(row.method), curve);
  RandomEngine engine(streamSeed(experiment.seed, "evaluate", run));
  if (const auto* genetic = std::get_if<ContinuousGeneticParameters>(&row.method)) {
    return runContinuous(scene, diary, [&](const ContinuousObserver& observer) {
      return continuousGeneticSearch(*scene.tree_a, *scene.tree_b, scene.a_from_b, *genetic, engine,
                                     observer);
    });
  }
  if (const auto* annealing = std::get_if<ContinuousAnnealingParameters>(&row.method)) {
    return runContinuous(scene, diary, [&](const ContinuousObserver& observer) {
      return continuousAnnealing(*scene.tree_a, *scene.tree_b, scene.a_from_b, *annealing, engine, observer);
    });
  }
  return runCombinatorial(std::get<SearchMethod>(row.method), scene, experiment.niches, engine, workspace,
                          diary);
}

}  // namespace concave_distance::evaluation
