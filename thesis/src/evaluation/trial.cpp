#include "trial.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "motion_trial.h"
#include "niche_questions.h"
#include "optimum_basin.h"
#include "search/grid/body_grid.h"
#include "thesis/src/continuous/continuous_annealing.h"
#include "thesis/src/continuous/continuous_genetic_search.h"

namespace concave_distance::evaluation {
namespace {

using Clock = std::chrono::steady_clock;

/// What one generation or iteration shows.
struct Moment {
  std::uint32_t iteration;
  double best_square;  ///< objective of the best so far, square metres
  double mean_square;
  double niches;
  double acceptance;
};

/// Looks for an individual that stands on the best node pair. A Baldwinian individual's squared distance is
/// that of the local minimum below it, so where it stands is computed here.
class StandingWatch {
 public:
  StandingWatch(const SearchMethod& method, const PairObjective& objective) : objective_(objective) {
    const auto* genetic = std::get_if<CombGaParameters>(&method);
    is_needed_ = genetic != nullptr && genetic->local_optimization == LocalOptimization::Baldwinian;
  }

  void look(const SearchRecord& record) {
    for (std::size_t i = 0; is_needed_ && i < record.point_count; ++i) {
      const TrialPoint& point = record.points[i];
      nearest_ = std::min(nearest_, objective_.evaluate(point.node_a, point.node_b, cost_).squared_distance);
    }
  }

  /// The least distance at which an individual stood; `answer`, metres, of searches that answer with one.
  double nearest(double answer) const { return is_needed_ ? std::sqrt(nearest_) : answer; }

 private:
  const PairObjective& objective_;
  bool is_needed_;
  double nearest_ = std::numeric_limits<double>::infinity();
  SearchCost cost_;  // of looking, which is not the search's
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

TrialRecord runCombinatorial(const SearchMethod& method, const SceneTruth& scene, RandomEngine& engine,
                             SearchWorkspace& workspace, Diary& diary, FoundPlaces* places) {
  const NicheRadii radii = radiiOf(scene, method);
  const InstantTruth& truth = scene.first();
  const PairObjective objective(*scene.a, *scene.b, truth.a_from_b);
  std::vector<TrialPoint> population;
  std::vector<IdentifiedNiche> seen;
  std::vector<std::uint32_t> order;
  StandingWatch standing(method, objective);
  const auto look = [&](const SearchRecord& record) {
    diary.startLooking();
    standing.look(record);
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
  diary.conclude(start, truth.node_distance * truth.node_distance, record);
  record.distance = std::sqrt(outcome.best.squared_distance);
  record.best_iteration = outcome.best_iteration;
  record.exact = record.distance <= truth.node_distance * kSame;
  record.standing = standing.nearest(record.distance) <= truth.node_distance * kSame;
  record.region = record.exact || record.distance < truth.region_limit;
  record.basin = record.region || leadsToOptimum(scene, outcome.best);
  record.below_second = record.distance < truth.second_distance;
  record.wrong_instants = record.exact ? 0 : 1;
  record.worst_excess = record.distance - truth.node_distance;
  record.cost = outcome.cost;
  record.flops = kFlopsOfAPair * outcome.cost.evaluations;
  std::vector<IdentifiedNiche> niches;
  identifyNiches(workspace.population, radii.niche, workspace.metric, niches, workspace.order);
  record.niches = static_cast<double>(niches.size());
  record.most_niches = static_cast<std::uint32_t>(niches.size());
  for (std::size_t i = 0; i < std::min(niches.size(), record.members.size()); ++i) {
    record.members[i] = niches[i].member_count;
    record.niche_distances[i] = std::sqrt(niches[i].best.squared_distance);
  }
  const auto best = std::min_element(workspace.population.begin(), workspace.population.end());
  record.point_a = gridOf(*scene.a).graph().positions[best->node_a.value];
  record.point_b = gridOf(*scene.b).graph().positions[best->node_b.value];
  if (places != nullptr) *places = placesOf(scene, niches, workspace.basins.minima());
  return record;
}

/// @param search what runs, given an observer
template <typename Search>
TrialRecord runContinuous(const SceneTruth& scene, Diary& diary, const Search& search) {
  const InstantTruth& truth = scene.first();
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
  diary.conclude(start, truth.exact_distance * truth.exact_distance, record);
  record.distance = result.distance;
  record.best_iteration = result.best_generation;
  record.feasible = result.is_feasible;
  record.point_a = result.best.point_a;
  record.point_b = result.best.point_b;
  record.exact = record.feasible && record.distance <= truth.exact_distance * kSame;
  record.standing = record.exact;
  record.region = record.feasible && record.distance < truth.exact_region_limit;
  record.basin = record.region || leadsToOptimum(scene, result.best.point_a, result.best.point_b);
  record.below_second = record.distance < truth.second_distance;
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

namespace {

/// A run at one pose. @param places that it found, when they are asked for
TrialRecord runOnce(const Method& method, const SceneTruth& scene, RandomEngine& engine,
                    SearchWorkspace& workspace, std::vector<CurvePoint>* curve, FoundPlaces* places) {
  Diary diary(curveStride(method), curve);
  const Eigen::Isometry3d& a_from_b = scene.first().a_from_b;
  if (const auto* genetic = std::get_if<ContinuousGeneticParameters>(&method)) {
    return runContinuous(scene, diary, [&](const ContinuousObserver& observer) {
      return continuousGeneticSearch(*scene.tree_a, *scene.tree_b, a_from_b, *genetic, engine, observer);
    });
  }
  if (const auto* annealing = std::get_if<ContinuousAnnealingParameters>(&method)) {
    return runContinuous(scene, diary, [&](const ContinuousObserver& observer) {
      return continuousAnnealing(*scene.tree_a, *scene.tree_b, a_from_b, *annealing, engine, observer);
    });
  }
  return runCombinatorial(std::get<SearchMethod>(method), scene, engine, workspace, diary, places);
}

/// Of the search that has used the workspace last.
std::vector<IndividualPoints> populationPoints(const SceneTruth& scene, const SearchWorkspace& workspace) {
  std::vector<IndividualPoints> points;
  for (const TrialPoint& individual : workspace.population) {
    const Eigen::Vector3d& a = gridOf(*scene.a).graph().positions[individual.node_a.value];
    const Eigen::Vector3d& b = gridOf(*scene.b).graph().positions[individual.node_b.value];
    points.push_back({(scene.first().a_from_b * b - a).norm(), a, b});
  }
  return points;
}

}  // namespace

std::vector<TrialRecord> runTrials(const Experiment& experiment, std::size_t row, std::size_t scene,
                                   const SceneTruth& truth, std::uint32_t first_run, std::uint32_t count,
                                   SearchWorkspace& workspace, std::vector<CurvePoint>* curve) {
  const ExperimentScene& place = experiment.scenes[scene];
  const ExperimentRow& what = experiment.rows[row];
  const Method method = what.methodOn(place);
  const bool has_niches = experiment.niches && (std::holds_alternative<SearchMethod>(method) ||
                                                std::holds_alternative<TrackerMethod>(method));
  const bool instant_by_instant = place.isMotion() || std::holds_alternative<TrackerMethod>(method) ||
                                  std::holds_alternative<EnumerationMethod>(method);
  NicheQuestions questions(truth);
  std::vector<TrialRecord> records;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint64_t seed = streamSeed(experiment.seed, "evaluate", first_run + i);
    if (instant_by_instant) {
      records.push_back(
          runAlong(method, what.motion, truth, seed, workspace, has_niches ? &questions : nullptr, i));
      continue;
    }
    RandomEngine engine(seed);
    FoundPlaces places;
    records.push_back(runOnce(method, truth, engine, workspace, curve, has_niches ? &places : nullptr));
    if (experiment.population_points && first_run + i == 0) {
      records.back().population = populationPoints(truth, workspace);
    }
    if (has_niches) questions.ask(0, i, std::move(places));
  }
  if (has_niches) questions.settle(records);
  return records;
}

}  // namespace concave_distance::evaluation
