#include "motion_trial.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "concave_distance/tracking/pair_tracker.h"
#include "enumeration.h"
#include "inheriting_search.h"
#include "search/automatic_radii.h"
#include "search/grid/body_grid.h"

namespace concave_distance::evaluation {
namespace {

using Clock = std::chrono::steady_clock;

/// Distances of surfaces that agree up to this, relative, are the same.
constexpr double kSurfaceSame = 1.0 + 1e-9;

/// What one instant gave.
struct Answer {
  double distance = 0.0;  ///< metres
  bool of_nodes = true;   ///< and not of the surfaces
  std::size_t niches = 0;
  std::uint64_t evaluations = 0;
  std::uint64_t descents = 0;
  std::uint64_t descent_steps = 0;
  bool found_by_proof = false;
  FoundPlaces places;
};

using Follower = std::function<void(const InstantTruth&, Answer&)>;

void take(const SearchCost& cost, Answer& answer) {
  answer.evaluations = cost.evaluations;
  answer.descents = cost.descents;
  answer.descent_steps = cost.descent_steps;
}

/// A search at every instant; a GA inherits.
class SearchFollower {
 public:
  SearchFollower(const SearchMethod& method, const MotionOptions& motion, const SceneTruth& scene,
                 std::uint64_t seed, SearchWorkspace& workspace)
      : method_(&method),
        scene_(&scene),
        engine_(seed),
        workspace_(&workspace),
        radii_(radiiOf(scene, method)) {
    if (geneticOf(method) != nullptr) {
      genetic_.emplace(method, motion.further.value_or(method), motion.guess, *scene.a, *scene.b, seed,
                       workspace);
    }
  }

  void operator()(const InstantTruth& instant, Answer& answer) {
    if (genetic_) {
      const GeneticResult result = genetic_->search(instant.a_from_b);
      answer.distance = std::sqrt(result.best.squared_distance);
      take(result.cost, answer);
    } else {
      const PairObjective objective(*scene_->a, *scene_->b, instant.a_from_b);
      workspace_->basins.clear();
      const SearchOutcome outcome = searchPair(objective, *method_, radii_, engine_, *workspace_);
      answer.distance = std::sqrt(outcome.best.squared_distance);
      take(outcome.cost, answer);
      identifyNiches(workspace_->population, radii_.niche, workspace_->metric, niches_, workspace_->order);
    }
    const std::vector<IdentifiedNiche>& niches = genetic_ ? genetic_->niches() : niches_;
    answer.niches = niches.size();
    answer.places = placesOf(*scene_, niches, workspace_->basins.minima());
  }

 private:
  const SearchMethod* method_;
  const SceneTruth* scene_;
  RandomEngine engine_;  ///< of all but a GA, which has its own
  SearchWorkspace* workspace_;
  NicheRadii radii_;
  std::vector<IdentifiedNiche> niches_;  ///< of all but a GA
  std::optional<InheritingSearch> genetic_;
};

class TrackerFollower {
 public:
  TrackerFollower(const TrackerMethod& method, const SceneTruth& scene, std::uint64_t seed)
      : forgets_(method.forgets),
        accuracy_(method.parameters.accuracy),
        tracker_("evaluate", scene.a, scene.b, withSeed(method.parameters, seed)) {}

  void operator()(const InstantTruth& instant, Answer& answer) {
    if (forgets_) tracker_.reset();
    tracker_.update(instant.a_from_b, instant.time, solution_);
    answer.distance = solution_.distance;
    answer.of_nodes = accuracy_ == AccuracyLevel::Nodes;
    answer.niches = solution_.niches.size();
    take(solution_.cost, answer);
    answer.found_by_proof = provesDistance(accuracy_) && solution_.search_miss;
    for (const TrackedNiche& niche : solution_.niches) {
      if (niche.distance > instant.niche_cutoff) break;  // ascending; beyond, no truth is known
      answer.places.reported.push_back({niche.witness.triangle_a, niche.witness.triangle_b, niche.distance});
    }
    answer.places.met = answer.places.reported;
  }

 private:
  static TrackerParameters withSeed(TrackerParameters parameters, std::uint64_t seed) {
    parameters.seed = seed;
    return parameters;
  }

  bool forgets_;
  AccuracyLevel accuracy_;
  PairTracker tracker_;
  PairSolution solution_;
};

void enumerate(const SceneTruth& scene, const InstantTruth& instant, Answer& answer) {
  answer.distance = std::sqrt(enumerateNodePairs(*scene.a, *scene.b, instant.a_from_b).squared_distance);
  answer.evaluations = gridOf(*scene.a).graph().nodeCount() * gridOf(*scene.b).graph().nodeCount();
}

Follower followerOf(const Method& method, const MotionOptions& motion, const SceneTruth& scene,
                    std::uint64_t seed, SearchWorkspace& workspace) {
  if (const auto* tracker = std::get_if<TrackerMethod>(&method)) {
    return [follower = std::make_shared<TrackerFollower>(*tracker, scene, seed)](
               const InstantTruth& instant, Answer& answer) { (*follower)(instant, answer); };
  }
  if (const auto* search = std::get_if<SearchMethod>(&method)) {
    return SearchFollower(*search, motion, scene, seed, workspace);
  }
  return [&scene](const InstantTruth& instant, Answer& answer) { enumerate(scene, instant, answer); };
}

/// Sums of whole numbers become means, rounded.
std::uint64_t meanOf(std::uint64_t sum, std::size_t count) {
  return (sum + count / 2) / count;
}

}  // namespace

NicheRadii radiiOf(const SceneTruth& scene, const SearchMethod& method) {
  const CombGaParameters* genetic = geneticOf(method);
  return automaticRadii(*scene.a, *scene.b, genetic != nullptr ? *genetic : CombGaParameters());
}

FoundPlaces placesOf(const SceneTruth& scene, const std::vector<IdentifiedNiche>& reported,
                     const std::vector<TrialPoint>& met) {
  const auto place_of = [&](const TrialPoint& point) {
    return FoundPlace{gridOf(*scene.a).nodes().originalTriangle(point.node_a),
                      gridOf(*scene.b).nodes().originalTriangle(point.node_b),
                      std::sqrt(point.squared_distance)};
  };
  FoundPlaces places;
  for (const IdentifiedNiche& niche : reported) places.reported.push_back(place_of(niche.best));
  for (const TrialPoint& point : met) places.met.push_back(place_of(point));
  return places;
}

TrialRecord runAlong(const Method& method, const MotionOptions& motion, const SceneTruth& scene,
                     std::uint64_t seed, SearchWorkspace& workspace, NicheQuestions* questions,
                     std::size_t run) {
  const Follower follow = followerOf(method, motion, scene, seed, workspace);
  const std::size_t count = scene.instants.size();
  const double weight = 1.0 / static_cast<double>(count);
  TrialRecord record;
  record.region = record.below_second = true;
  for (std::size_t k = 0; k < count; ++k) {
    const InstantTruth& instant = scene.instants[k];
    Answer answer;
    const Clock::time_point start = Clock::now();
    follow(instant, answer);
    record.microseconds += weight * std::chrono::duration<double, std::micro>(Clock::now() - start).count();
    const double best = answer.of_nodes ? instant.node_distance : instant.exact_distance;
    const bool exact = answer.distance <= best * (answer.of_nodes ? kSame : kSurfaceSame);
    record.distance += weight * answer.distance;
    record.wrong_instants += exact ? 0 : 1;
    record.worst_excess = std::max(record.worst_excess, answer.distance - best);
    record.region =
        record.region &&
        (exact || answer.distance < (answer.of_nodes ? instant.region_limit : instant.exact_region_limit));
    record.below_second = record.below_second && answer.distance < instant.second_distance;
    record.niches += weight * static_cast<double>(answer.niches);
    record.most_niches = std::max(record.most_niches, static_cast<std::uint32_t>(answer.niches));
    record.cost.evaluations += answer.evaluations;
    record.cost.descents += answer.descents;
    record.cost.descent_steps += answer.descent_steps;
    record.proof_finds += answer.found_by_proof ? 1 : 0;
    if (questions != nullptr) questions->ask(k, run, std::move(answer.places));
  }
  record.exact = record.wrong_instants == 0;
  record.standing = record.exact;
  record.cost.evaluations = meanOf(record.cost.evaluations, count);
  record.cost.descents = meanOf(record.cost.descents, count);
  record.cost.descent_steps = meanOf(record.cost.descent_steps, count);
  record.flops = kFlopsOfAPair * record.cost.evaluations;
  return record;
}

}  // namespace concave_distance::evaluation
