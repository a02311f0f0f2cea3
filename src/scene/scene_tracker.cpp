#include "concave_distance/scene/scene_tracker.h"

#include <algorithm>
#include <new>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "concave_distance/base/error.h"
#include "cycle_solver.h"
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

// An edit shares the bodies that it leaves as they are.
bool isOfTheSameBodies(const TrackedPair& tracked, const Scene& scene, const ScenePair& wanted) {
  return tracked.body_a.get() == &scene.bodies[wanted.body_a] &&
         tracked.body_b.get() == &scene.bodies[wanted.body_b];
}

/// Triangles of a scene up to which what niches need, some 500 bytes each, is made before anybody asks.
constexpr std::size_t kMostTrianglesAhead = 1'000'000;

}  // namespace

SceneTracker::SceneTracker(SceneTrackerOptions options)
    : options_(options), solver_(std::make_unique<CycleSolver>(options_.threads, options_.stop)) {
  if (options_.prepares_in_background) preparation_ = std::make_unique<NichePreparation>();
}

SceneTracker::~SceneTracker() = default;

std::vector<std::optional<std::size_t>> SceneTracker::placesNow(const Scene& scene) const {
  std::vector<std::optional<std::size_t>> places(scene.pairs.size());
  // Usually an edit leaves most pairs as they are, in their places.
  std::unordered_map<std::string_view, std::size_t> moved;
  for (const ScenePair& pair : scene.pairs) requireBodies(scene, pair);
  for (std::size_t index = 0; index < pairs_.size(); ++index) {
    if (index < places.size() && pairs_[index]->origin.get() == &scene.pairs[index] &&
        isOfTheSameBodies(*pairs_[index], scene, scene.pairs[index])) {
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
  const std::vector<std::optional<std::size_t>> places = placesNow(scene);
  std::vector<bool> stays(pairs_.size(), false);
  for (const std::optional<std::size_t>& place : places) {
    if (place) stays[*place] = true;
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
  for (std::size_t index = 0; index < places.size(); ++index) {
    next[index] = places[index] ? pairs_[*places[index]]
                                : std::make_shared<TrackedPair>(scene, index, largest_retired_id);
  }
  retired_.reserve(retired_.size() + retired.size());

  // Nothing below allocates.
  for (std::size_t index = 0; index < places.size(); ++index) {
    if (!places[index] || next[index]->origin.get() == &scene.pairs[index]) continue;
    next[index]->adopt(scene.pairs.share(index), settings_changed);
  }
  for (std::shared_ptr<TrackedPair>& pair : retired) {
    pair->stopWatching();
    retired_.push_back(std::move(pair));
  }
  pairs_ = std::move(next);
  largest_retired_id_ = largest_retired_id;
  body_count_ = scene.bodies.size();
  prepareAhead(scene);
}

// Many triangles take much memory: they wait until somebody wants their niches, as all do when none is left.
void SceneTracker::prepareAhead(const Scene& scene) {
  std::size_t triangles = 0;
  for (const SceneBody& body : scene.bodies) triangles += body.mesh->surface().triangleCount();
  if (!preparation_ || triangles > kMostTrianglesAhead) return;
  try {
    for (const auto& pair : pairs_) {
      if (pair->origin->enabled) isPrepared(*pair);
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
  demand_.assign(pairs_.size(), demand);
  const auto locate = [&](std::size_t index) {
    const ScenePair& pair = *pairs_[index]->origin;
    const std::optional<Eigen::Isometry3d>& world_from_a = world_from_body[pair.body_a];
    const std::optional<Eigen::Isometry3d>& world_from_b = world_from_body[pair.body_b];
    PairInput input;
    input.time = time;
    input.located = world_from_a && world_from_b;
    if (input.located) input.a_from_b = world_from_a->inverse(Eigen::Isometry) * *world_from_b;
    return input;
  };
  return update(demand_, std::cref(locate), end);  // a copy in std::function would allocate
}

CycleCounts SceneTracker::update(const std::vector<PairDemand>& demand, const Locate& locate,
                                 WorkLimit::Clock::time_point end) {
  requireCount("demands", demand.size(), pairs_.size(), "pairs");
  if (std::exchange(interrupted_, true)) {
    for (auto& pair : pairs_) pair->discard();
  }
  CycleCounts counts;
  choosePairs(demand, locate, counts);
  solver_->begin(to_solve_);
  if (end == kNoCycleEnd) {
    solver_->solveAll();
  } else {
    solver_->solveUntil(end);
  }
  for (auto& pair : pairs_) {
    if (pair->demand.due) pair->watchWarning();
  }
  count(counts);
  interrupted_ = false;
  return counts;
}

void SceneTracker::choosePairs(const std::vector<PairDemand>& demand, const Locate& locate,
                               CycleCounts& counts) {
  to_solve_.clear();
  for (std::size_t index = 0; index < pairs_.size(); ++index) {
    TrackedPair& pair = *pairs_[index];
    const bool was_watched = pair.demand.watched;
    pair.demand = pair.origin->enabled ? demand[index] : PairDemand{};
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
  counts.helper_cpu_seconds = solver_->helperSeconds();
}

}  // namespace concave_distance
