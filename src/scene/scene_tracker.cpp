#include "concave_distance/scene/scene_tracker.h"

#include <algorithm>
#include <new>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "concave_distance/base/error.h"
#include "cycle_solver.h"
#include "near_pairs.h"
#include "niche_preparation.h"

namespace concave_distance {
namespace {

void requireBodies(const Scene& scene, const ScenePair& pair) {
  const auto where = [&] { return "scene, pair '" + pair.name + "'"; };
  const std::size_t count = scene.bodies.size();
  for (const std::size_t body : {pair.body_a, pair.body_b}) {
    if (body >= count) {
      throw Error(where(), "it names body " + std::to_string(body) + " of " + std::to_string(count),
                  "bodies are numbered from 0 in the order of scene.bodies");
    }
    if (!scene.bodies[body].mesh) {
      throw Error(where(), "body '" + scene.bodies[body].name + "' has no mesh", "set SceneBody::mesh");
    }
  }
  if (pair.body_a == pair.body_b) {
    throw Error(where(), "both its bodies are '" + scene.bodies[pair.body_a].name + "'", "name two bodies");
  }
}

void requireCount(const std::string& what, std::size_t given, std::size_t needed, const std::string& each) {
  if (given == needed) return;
  throw Error("SceneTracker::update",
              std::to_string(given) + " " + what + " for " + std::to_string(needed) + " " + each,
              "give one for each, in their order");
}

bool isOfTheSameBodies(const TrackedPair& tracked, const Scene& scene, const ScenePair& wanted) {
  return isSameBody(*tracked.body_a, scene.bodies[wanted.body_a]) &&
         isSameBody(*tracked.body_b, scene.bodies[wanted.body_b]);
}

// An edit shares the bodies that it leaves as they are.
bool isUntouched(const TrackedPair& tracked, const Scene& scene, std::size_t index) {
  const ScenePair& wanted = scene.pairs[index];
  return tracked.origin.get() == &wanted && tracked.body_a.get() == &scene.bodies[wanted.body_a] &&
         tracked.body_b.get() == &scene.bodies[wanted.body_b];
}

/// Triangles of a scene up to which what niches need, some 500 bytes each, is made before anybody asks.
constexpr std::size_t kMostTrianglesAhead = 1'000'000;

}  // namespace

SceneTracker::SceneTracker(SceneTrackerOptions options)
    : options_(options),
      solver_(std::make_unique<CycleSolver>(options_.threads, options_.stop)),
      near_(std::make_unique<NearPairs>()) {
  if (options_.prepares_in_background) preparation_ = std::make_unique<NichePreparation>();
}

SceneTracker::~SceneTracker() = default;

std::vector<std::optional<std::size_t>> SceneTracker::placesNow(const Scene& scene) const {
  std::vector<std::optional<std::size_t>> places(scene.pairs.size());
  // Usually an edit leaves most pairs as they are, in their places.
  std::unordered_map<std::string_view, std::size_t> moved;
  for (const ScenePair& pair : scene.pairs) requireBodies(scene, pair);
  for (std::size_t index = 0; index < pairs_.size(); ++index) {
    if (index < places.size() && index < listed_ && isUntouched(*pairs_[index], scene, index)) {
      places[index] = index;
    } else {
      moved.emplace(pairs_[index]->origin->name, index);
    }
  }
  for (std::size_t index = 0; index < places.size(); ++index) {
    if (places[index]) continue;
    const ScenePair& wanted = scene.pairs[index];
    const auto found = moved.find(wanted.name);
    if (found != moved.end() && isOfTheSameBodies(*pairs_[found->second], scene, wanted)) {
      places[index] = found->second;
    }
  }
  return places;
}

void SceneTracker::setScene(const Scene& scene, bool settings_changed) {
  for (const SceneBody& body : scene.bodies) {
    const bool may_be_near = body.pair_class != 0 || body.added_rule;
    if (may_be_near && !body.mesh) {
      throw Error("scene", "body '" + body.name + "' has no mesh", "set SceneBody::mesh");
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
  prepareAhead(scene);
}

void SceneTracker::refreshPairs() {
  pairs_.resize(listed_);
  pairs_.insert(pairs_.end(), near_->pairs().begin(), near_->pairs().end());
  near_revision_ = near_->revision();
}

// Many triangles take much memory: they wait until somebody wants their niches, as all do when none is left.
void SceneTracker::prepareAhead(const Scene& scene) {
  std::size_t triangles = 0;
  for (const SceneBody& body : scene.bodies) {
    if (body.mesh) triangles += body.mesh->surface().triangleCount();
  }
  if (!preparation_ || triangles > kMostTrianglesAhead) return;
  try {
    for (const auto& pair : pairs_) {
      if (pair->origin->enabled && hasNiches(*pair->body_a) && hasNiches(*pair->body_b)) isPrepared(*pair);
    }
    // Which of the others will be near is not known: each mesh once, as if against itself.
    const TrackerParameters& parameters = scene.defaults.pairs.tracker;
    for (const SceneBody& body : scene.bodies) {
      const bool may_be_near = body.pair_class != 0 || body.added_rule;
      if (!may_be_near || !provesDistance(parameters.accuracy) || !hasNiches(body)) continue;
      preparation_->addAhead(body.mesh, parameters);
    }
  } catch (const std::bad_alloc&) {
    // The scene is tracked already; a cycle that wants the niches tries again.
  }
}

// Begins the preparation where there is none yet. The other levels have no distance without their niches.
bool SceneTracker::isPrepared(TrackedPair& pair) {
  const TrackerParameters& parameters = pair.settings.tracker;
  if (!preparation_ || !provesDistance(parameters.accuracy)) return true;
  if (!pair.preparation || !pair.preparation->suffices(parameters)) {
    // The pair has it when it is sure to run.
    auto task = std::make_shared<PreparationTask>(pair.body_a->mesh, pair.body_b->mesh, parameters);
    preparation_->add(task);
    pair.preparation = std::move(task);
  }
  return pair.preparation->isDone();
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

CycleCounts SceneTracker::update(const std::vector<std::optional<Eigen::Isometry3d>>& world_from_body,
                                 double time, const PairDemand& demand, WorkLimit::Clock::time_point end) {
  requireCount("poses", world_from_body.size(), body_count_, "bodies");
  poses_.times.assign(1, time);
  poses_.now = time;
  poses_.reset(body_count_);
  for (std::size_t body = 0; body < body_count_; ++body) {
    if (!world_from_body[body]) continue;
    poses_.newest[body] = 0;
    poses_.poses[body] = *world_from_body[body];
  }
  return update(
      poses_, [&demand](std::size_t, const TrackedPair&) { return demand; }, end);
}

CycleCounts SceneTracker::update(const BodyPoses& poses, const DemandOf& demand_of,
                                 WorkLimit::Clock::time_point end) {
  requireCount("poses", poses.newest.size(), body_count_, "bodies");
  begin();
  near_->update(poses, largest_retired_id_);
  if (near_revision_ != near_->revision()) refreshPairs();
  const auto locate_pair = [&](std::size_t index) { return locate(poses, *pairs_[index]->origin); };
  return runCycle(pairs_.size(), demand_of, locate_pair, end);
}

CycleCounts SceneTracker::update(const std::vector<PairDemand>& demand, const Locate& locate,
                                 WorkLimit::Clock::time_point end) {
  requireCount("demands", demand.size(), listed_, "pairs");
  begin();
  const auto demand_of = [&](std::size_t index, const TrackedPair&) { return demand[index]; };
  return runCycle(listed_, demand_of, locate, end);
}

PairInput SceneTracker::locate(const BodyPoses& poses, const ScenePair& pair) const {
  const std::int32_t newest_a = poses.newest[pair.body_a];
  const std::int32_t newest_b = poses.newest[pair.body_b];
  PairInput input;
  input.fixed = newest_a == BodyPoses::kFixed && newest_b == BodyPoses::kFixed;
  input.located = newest_a != BodyPoses::kUnknown && newest_b != BodyPoses::kUnknown;
  if (!input.located) return input;
  const std::int32_t common = newest_a == BodyPoses::kFixed   ? newest_b
                              : newest_b == BodyPoses::kFixed ? newest_a
                                                              : std::min(newest_a, newest_b);
  // A body whose pose is known only from later on may be anywhere at that time.
  input.located = input.fixed || common >= std::max(poses.oldest[pair.body_a], poses.oldest[pair.body_b]);
  if (!input.located) return input;
  const auto time = static_cast<std::size_t>(std::max(common, 0));
  input.time = input.fixed ? poses.now : poses.times[time];
  input.a_from_b =
      poses.relative ? poses.relative(pair.body_a, pair.body_b, time)
                     : poses.pose(pair.body_a, time).inverse(Eigen::Isometry) * poses.pose(pair.body_b, time);
  return input;
}

void SceneTracker::begin() {
  if (!std::exchange(interrupted_, true)) return;
  for (auto& pair : pairs_) pair->discard();
  near_->recover();
}

template <typename Demand, typename LocatePair>
CycleCounts SceneTracker::runCycle(std::size_t count, const Demand& demand_of, const LocatePair& locate,
                                   WorkLimit::Clock::time_point end) {
  CycleCounts counts;
  to_solve_.clear();
  for (std::size_t index = 0; index < count; ++index) {
    TrackedPair& pair = *pairs_[index];
    const bool was_watched = pair.demand.watched;
    pair.demand = pair.origin->enabled ? demand_of(index, pair) : PairDemand{};
    if (!pair.demand.watched) {
      pair.warning_changed = false;
      if (was_watched) pair.stopWatching();
      continue;
    }
    ++counts.watched;
    if ((pair.demand.niches || pair.demand.effects) && !isPrepared(pair)) {
      pair.demand.niches = pair.demand.effects = false;
      ++counts.unprepared;
    }
    if (pair.demand.due && pair.locate(locate(index), options_.stop)) to_solve_.push_back(&pair);
  }
  solver_->begin(to_solve_);
  if (end == kNoCycleEnd) {
    solver_->solveAll();
  } else {
    solver_->solveUntil(end);
  }
  for (std::size_t index = 0; index < count; ++index) {
    if (pairs_[index]->demand.due) pairs_[index]->watchWarning();
  }
  this->count(count, counts);
  interrupted_ = false;
  return counts;
}

const OtherPairs& SceneTracker::others() const {
  return near_->others();
}

void SceneTracker::count(std::size_t pairs, CycleCounts& counts) const {
  for (std::size_t index = 0; index < pairs; ++index) {
    const TrackedPair& pair = *pairs_[index];
    if (!pair.demand.due) continue;
    counts.repeated += pair.repeated ? 1 : 0;
    counts.beyond_cutoff += pair.state == PairState::BeyondCutoff ? 1 : 0;
    counts.not_located += pair.state == PairState::NotLocated ? 1 : 0;
  }
  for (TrackedPair* pair : to_solve_) {
    if (!pair->solved()) continue;  // stopped before its turn
    counts.effects += pair->effects.takeCounts();
    counts.addSolve(pair->solution);
    counts.put_off += pair->put_off ? 1 : 0;
  }
  counts.helper_cpu_seconds = solver_->helperSeconds();
}

}  // namespace concave_distance
