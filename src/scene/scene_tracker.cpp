#include "concave_distance/scene/scene_tracker.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "body_preparation.h"
#include "concave_distance/base/error.h"
#include "cycle_solver.h"
#include "listed_places.h"
#include "near_pairs.h"
#include "niche_preparation.h"

namespace concave_distance {
namespace {

/// prepare() runs so many cycles: the first is cold, and the others let the buffers of warm ones grow, at
/// last of those with an end.
constexpr int kPreparingCycles = 6;
constexpr int kPreparingCyclesWithEnd = 3;
constexpr double kPreparingStep = 1e-3;  // s between them
constexpr double kPreparingShift =
    1e-6;  // of the smaller body: they move B, because a pair at rest does less

/// Locates pairs by plain poses of one time. Its caller keeps the poses.
struct LocateAt {
  const SceneTracker::Poses& poses;
  double time;

  PairInput operator()(std::size_t a, std::size_t b) const {
    PairInput input;
    input.located = poses[a] && poses[b];
    if (!input.located) return input;
    input.a_from_b = poses[a]->inverse(Eigen::Isometry) * *poses[b];
    input.time = time;
    return input;
  }
};

}  // namespace

SceneTracker::SceneTracker(SceneTrackerOptions options)
    : options_(options),
      solver_(std::make_unique<CycleSolver>(options_.threads, options_.stop)),
      near_(std::make_unique<NearPairs>()) {
  if (options_.prepares_in_background) preparation_ = std::make_unique<NichePreparation>();
}

SceneTracker::~SceneTracker() = default;

std::vector<std::optional<std::size_t>> SceneTracker::placesNow(const Scene& scene) const {
  return placesInTracker(pairs_, listed_, scene);
}

void SceneTracker::setScene(const Scene& scene, bool settings_changed) {
  for (const std::size_t body : scene.rules.allBodies().indices()) {
    if (!scene.bodies[body].mesh) {
      throw Error("scene", "body '" + scene.bodies[body].name + "' has no mesh", "set SceneBody::mesh");
    }
  }
  const std::vector<std::optional<std::size_t>> places = placesNow(scene);
  NearPairs::Plan near = near_->plan(scene, settings_changed);
  std::vector<bool> stays(pairs_.size(), false);
  for (const std::optional<std::size_t>& place : places) {
    if (place) stays[*place] = true;
  }
  for (std::size_t index = 0; index < near.pairs.size(); ++index) {
    if (near.pairs[index]) stays[listed_ + index] = true;
  }
  // Ids are not used again: pairs that come later begin above all that are gone.
  std::uint64_t largest_retired_id = largest_retired_id_;
  Pairs retired;
  for (std::size_t place = 0; place < pairs_.size(); ++place) {
    if (stays[place]) continue;
    largest_retired_id = std::max(largest_retired_id, pairs_[place]->largest_id);
    if (pairs_[place]->warning.state() != WarningState::Clear) retired.push_back(pairs_[place]);
  }
  Pairs next(places.size());
  next.reserve(places.size() + near.pairs.size());
  for (std::size_t index = 0; index < places.size(); ++index) {
    next[index] = places[index] ? pairs_[*places[index]]
                                : std::make_shared<TrackedPair>(scene, index, largest_retired_id);
  }
  retired_.reserve(retired_.size() + retired.size());

  // Nothing below allocates.
  for (std::size_t index = 0; index < places.size(); ++index) {
    if (!places[index] || isUntouched(*next[index], scene, index)) continue;
    const ScenePair& pair = scene.pairs[index];
    next[index]->adopt(scene.pairs.share(index), scene.bodies.share(pair.body_a),
                       scene.bodies.share(pair.body_b), settings_changed);
  }
  for (std::shared_ptr<TrackedPair>& pair : retired) {
    pair->stopWatching();
    retired_.push_back(std::move(pair));
  }
  pairs_ = std::move(next);
  listed_ = pairs_.size();
  largest_retired_id_ = largest_retired_id;
  near_->adopt(std::move(near), settings_changed, largest_retired_id_);
  refreshPairs();
  body_count_ = scene.bodies.size();
  if (preparation_) preparation_->addAhead(scene, pairs_);
}

void SceneTracker::refreshPairs() {
  pairs_.resize(listed_);
  pairs_.insert(pairs_.end(), near_->pairs().begin(), near_->pairs().end());
  near_revision_ = near_->revision();
}

SceneTracker::Pairs SceneTracker::takeRetired() {
  return std::exchange(retired_, {});
}

void SceneTracker::restart() {
  for (auto& pair : pairs_) pair->restart();
}

void SceneTracker::restart(std::size_t pair) {
  if (pair >= pairs_.size()) {
    throw Error("SceneTracker::restart",
                "pair " + std::to_string(pair) + " of " + std::to_string(pairs_.size()),
                "pairs are numbered from 0 in the order of scene.pairs");
  }
  pairs_[pair]->restart();
}

CycleCounts SceneTracker::update(const Poses& world_from_body, double time, const PairDemand& demand,
                                 WorkLimit::Clock::time_point end) {
  return update(
      world_from_body, time, [&demand](std::size_t, const TrackedPair&) { return demand; }, end);
}

CycleCounts SceneTracker::update(const Poses& world_from_body, double time, const DemandOf& demand_of,
                                 WorkLimit::Clock::time_point end) {
  return update(world_from_body, time, demand_of, LocateAt{world_from_body, time}, end);
}

CycleCounts SceneTracker::update(const Poses& world_from_body, double now, const DemandOf& demand_of,
                                 const Locate& locate, WorkLimit::Clock::time_point end) {
  findNear(world_from_body, now);
  return runCycle(*solver_, demand_of, locate, end);
}

void SceneTracker::findNear(const Poses& world_from_body, double now) {
  if (world_from_body.size() != body_count_) {
    throw Error(
        "SceneTracker::update",
        std::to_string(world_from_body.size()) + " poses for " + std::to_string(body_count_) + " bodies",
        "give one for each, in their order");
  }
  begin();
  near_->update(world_from_body, now, largest_retired_id_);
  if (near_revision_ != near_->revision()) refreshPairs();
}

void SceneTracker::begin() {
  if (!std::exchange(interrupted_, true)) return;
  for (auto& pair : pairs_) pair->discard();
  near_->recover();
}

CycleCounts SceneTracker::runCycle(CycleSolver& solver, const DemandOf& demand_of, const Locate& locate,
                                   WorkLimit::Clock::time_point end, bool watches) {
  CycleCounts counts;
  to_solve_.clear();
  for (std::size_t index = 0; index < pairs_.size(); ++index) {
    TrackedPair& pair = *pairs_[index];
    const bool was_watched = pair.demand.watched;
    pair.demand = pair.origin->enabled ? demand_of(index, pair) : PairDemand{};
    if (!pair.demand.watched) {
      pair.warning_changed = false;
      if (was_watched) pair.stopWatching();
      continue;
    }
    ++counts.watched;
    if ((pair.demand.niches || pair.demand.effects) && preparation_ && !preparation_->isPrepared(pair)) {
      pair.demand.niches = pair.demand.effects = false;
      ++counts.unprepared;
    }
    if (pair.demand.due && pair.locate(locate(pair.origin->body_a, pair.origin->body_b), options_.stop))
      to_solve_.push_back(&pair);
  }
  solver.begin(to_solve_);
  if (end == kNoCycleEnd) {
    solver.solveAll();
  } else {
    solver.solveUntil(end);
  }
  for (const auto& pair : pairs_) {
    if (watches && pair->demand.due) pair->watchWarning();
  }
  count(counts);
  counts.helper_cpu_seconds = solver.helperSeconds();
  interrupted_ = false;
  return counts;
}

PreparationCounts SceneTracker::prepare(const Poses& world_from_body, double time, const PairDemand& demand,
                                        const PreparationSettings& settings) {
  using Clock = WorkLimit::Clock;
  const std::chrono::duration<double> limit(settings.time_limit);
  const Clock::time_point end = limit < std::chrono::hours(24 * 365)
                                    ? Clock::now() + std::chrono::duration_cast<Clock::duration>(limit)
                                    : kNoCycleEnd;
  findNear(world_from_body, time);
  interrupted_ = false;
  PreparationCounts counts;
  if (prepareBodies(demand, settings, end, counts)) {
    runPreparingCycles(LocateAt{world_from_body, time}, demand, settings, end, counts);
  }
  return counts;
}

bool SceneTracker::prepareBodies(const PairDemand& demand, const PreparationSettings& settings,
                                 WorkLimit::Clock::time_point end, PreparationCounts& counts) {
  if (!demand.niches && !demand.effects) return true;
  BodyPreparation bodies(settings, end, options_.stop);
  for (const auto& pair : pairs_) {
    if (pair->origin->enabled) bodies.add(*pair->body_a->mesh, *pair->body_b->mesh, pair->settings.tracker);
  }
  bodies.addAhead(near_->scene());
  const bool is_whole = bodies.run();
  bodies.count(counts);
  for (const auto& pair : pairs_) {
    const TrackerParameters& parameters = pair->settings.tracker;
    if (!pair->origin->enabled || !provesDistance(parameters.accuracy)) continue;
    // One that a thread in the background has only begun is not waited for.
    const bool has_all =
        pair->preparation && pair->preparation->isDone() && pair->preparation->isSearchDone();
    if (!is_whole || has_all) continue;
    auto task = std::make_shared<PreparationTask>(pair->body_a->mesh, pair->body_b->mesh, parameters);
    task->run();  // finds all that it makes
    pair->preparation = std::move(task);
  }
  return is_whole;
}

// Pairs whose last answer is of these poses are left as they are.
void SceneTracker::runPreparingCycles(const Locate& locate, const PairDemand& demand,
                                      const PreparationSettings& settings, WorkLimit::Clock::time_point end,
                                      PreparationCounts& counts) {
  to_solve_.reserve(pairs_.size());
  solver_->reserve(pairs_.size());
  std::vector<PairDemand> demands(pairs_.size(), demand);
  for (std::size_t index = 0; index < pairs_.size(); ++index) {
    const TrackedPair& pair = *pairs_[index];
    const PairInput input = locate(pair.origin->body_a, pair.origin->body_b);
    const bool has_niches = pair.demand.niches || !demand.niches;
    const bool is_there = pair.input.a_from_b.matrix() == input.a_from_b.matrix();
    if (pair.solved() && has_niches && is_there) demands[index].due = false;
  }
  const auto& bodies = near_->scene().bodies;
  CycleSolver cold_solver(settings.threads, options_.stop);
  CycleCounts cycle;
  for (int left = kPreparingCycles - 1; left >= 0; --left) {
    const auto locate_shifted = [&](std::size_t a, std::size_t b) {
      PairInput input = locate(a, b);
      if (left == 0) return input;
      const double size = std::min(bodies[a].mesh->diameter(), bodies[b].mesh->diameter());
      input.a_from_b.translation().x() += (left % 2 == 0 ? 1.0 : -1.0) * kPreparingShift * size;
      input.time -= left * kPreparingStep;
      return input;
    };
    const auto demand_of = [&](std::size_t index, const TrackedPair&) { return demands[index]; };
    begin();
    CycleSolver& solver = left == kPreparingCycles - 1 ? cold_solver : *solver_;
    const bool has_end = left < kPreparingCyclesWithEnd;
    const WorkLimit::Clock::time_point far_end = WorkLimit::Clock::now() + std::chrono::hours(1);
    cycle = runCycle(solver, demand_of, locate_shifted, has_end ? std::min(end, far_end) : end, false);
  }
  counts.lists_left = cycle.put_off + cycle.unprepared;
  for (std::size_t index = 0; index < pairs_.size(); ++index) {
    if (demands[index].due) pairs_[index]->effects.reset();
  }
}

const OtherPairs& SceneTracker::others() const {
  return near_->others();
}

void SceneTracker::count(CycleCounts& counts) const {
  for (const auto& pair : pairs_) {
    if (!pair->demand.due) continue;
    counts.repeated += pair->repeated ? 1 : 0;
    counts.beyond_cutoff += pair->state == PairState::BeyondCutoff ? 1 : 0;
    counts.not_located += pair->state == PairState::NotLocated ? 1 : 0;
  }
  for (TrackedPair* pair : to_solve_) {
    if (!pair->solved()) continue;  // stopped before its turn
    counts.effects += pair->effects.takeCounts();
    counts.addSolve(pair->solution);
    counts.put_off += pair->put_off ? 1 : 0;
  }
}

}  // namespace concave_distance
