#include "concave_distance/scene/scene_tracker.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "base/helping_threads.h"
#include "concave_distance/base/error.h"
#include "concave_distance/search/prepare_search.h"
#include "niche_preparation.h"
#include "solver_threads.h"
#include "solving_order.h"

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

/// A list that stays unfinished has a cycle of its own in every so many: it leaves no time to those after it.
constexpr std::uint32_t kCyclesToOwnOne = 4;

bool ownsCycle(const TrackedPair& pair) {
  return pair.cycles_unfinished % kCyclesToOwnOne == kCyclesToOwnOne - 1;
}

}  // namespace

struct SceneTracker::Arena {
  explicit Arena(std::uint32_t count) : threads(makeSolverArena(count)) {}

  tbb::task_arena threads;
  HelpingThreads helpers;
};

/// A pair in the order of a cycle with an end.
struct SceneTracker::Turn {
  TrackedPair* pair;
  std::size_t place;  ///< in the order of the scene
  PairUrgency urgency;
  double seconds_after;  ///< that the pairs after it are expected to need
};

SceneTracker::SceneTracker(SceneTrackerOptions options)
    : options_(options), arena_(std::make_unique<Arena>(options_.threads)) {
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

// Many triangles take much memory: they wait until somebody wants their niches.
void SceneTracker::prepareAhead(const Scene& scene) {
  std::size_t triangles = 0;
  for (const SceneBody& body : scene.bodies) triangles += body.mesh->surface().triangleCount();
  if (!preparation_ || triangles > kMostTrianglesAhead) return;
  for (const auto& pair : pairs_) {
    if (pair->origin->enabled) isPrepared(*pair);
  }
}

// Of what is not, the preparation begins. The other levels have no distance without their niches.
bool SceneTracker::isPrepared(TrackedPair& pair) {
  const TrackerParameters& parameters = pair.settings.tracker;
  if (!preparation_ || !provesDistance(parameters.accuracy)) return true;
  if (!pair.preparation || !pair.preparation->suffices(parameters)) {
    pair.preparation = std::make_shared<PreparationTask>(pair.body_a->mesh, pair.body_b->mesh, parameters);
    preparation_->add(pair.preparation);
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
  arena_->helpers.begin();
  prepareSearches();
  if (end == kNoCycleEnd) {
    solveAll();
  } else {
    solveUntil(end);
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
  counts.helper_cpu_seconds = arena_->helpers.seconds();
}

// Grids and metrics of bodies whose niches are searched for the first time are made together, in parallel.
void SceneTracker::prepareSearches() {
  if (isStopped()) return;
  to_prepare_.clear();
  for (const TrackedPair* pair : to_solve_) {
    if (!pair->needsSearch()) continue;
    for (const BodyMesh* body : {pair->body_a->mesh.get(), pair->body_b->mesh.get()}) {
      if (!searchPreparationOf(body->asSolved()).is_complete) to_prepare_.push_back(&body->asSolved());
    }
  }
  if (!to_prepare_.empty()) {
    arena_->threads.execute([&] { prepareSearch(to_prepare_); });
  }
}

void SceneTracker::solveAll() {
  if (to_solve_.empty()) return;
  const auto solve_at = [&](std::size_t index) { arena_->helpers.share([&] { solve(*to_solve_[index]); }); };
  // One pair, too, is solved in the arena: long ones use its idle threads.
  arena_->threads.execute([&] {
    if (options_.threads == 1 || to_solve_.size() == 1) {
      for (std::size_t index = 0; index < to_solve_.size(); ++index) solve_at(index);
    } else {
      tbb::parallel_for(std::size_t{0}, to_solve_.size(), solve_at, tbb::simple_partitioner());
    }
  });
}

void SceneTracker::solve(TrackedPair& pair) {
  if (isStopped()) {
    pair.stop();
    return;
  }
  pair.solve();
}

// Two rounds in the order of urgency: the distances, so that each has its proof before any list takes its
// time, then niches and effects. A pair leaves those after it what they needed last, but takes half of what
// is left at least, so that a list which needs long does not wait for ever.
void SceneTracker::solveUntil(WorkLimit::Clock::time_point end) {
  using Clock = WorkLimit::Clock;
  using Seconds = std::chrono::duration<double>;
  if (isStopped()) {
    for (TrackedPair* pair : to_solve_) pair->stop();
    return;
  }
  turns_.clear();
  for (TrackedPair* pair : to_solve_) {
    const PairSolution& last = pair->solution;
    const std::uint32_t waited = std::max(pair->cycles_put_off, ownsCycle(*pair) ? kLongestWait : 0);
    turns_.push_back({pair, turns_.size(), {last.distance, last.closing_speed, waited}, 0.0});
  }
  sortByUrgency();
  forEachInOrder([&](Turn& turn) {
    turn.pair->prove(end);
    const PairSolution& now = turn.pair->solution;
    if (std::isnan(now.distance)) return;  // of a level that proves none
    turn.urgency.distance = now.distance;
    turn.urgency.closing_speed = now.closing_speed;
  });
  sortByUrgency();
  double seconds_after = 0.0;
  for (std::size_t i = turns_.size(); i-- > 0;) {
    turns_[i].seconds_after = seconds_after;
    seconds_after += turns_[i].pair->seconds_to_finish;
  }
  const auto threads = static_cast<double>(arena_->threads.max_concurrency());
  const double all = Seconds(end - Clock::now()).count();
  forEachInOrder([&](Turn& turn) {
    TrackedPair& pair = *turn.pair;
    const Clock::time_point now = Clock::now();
    const double left = Seconds(end - now).count();
    const double after = ownsCycle(pair) ? 0.0 : turn.seconds_after / threads;
    const double own = std::max(0.5 * left, left - after);
    pair.finish(now + std::chrono::duration_cast<Clock::duration>(Seconds(own)));
    const bool had_its_turn = own > 0.0 && own >= 0.5 * all;
    pair.cycles_put_off = pair.put_off && !had_its_turn ? pair.cycles_put_off + 1 : 0;
  });
}

// Threads take turns in their order, each the next one.
template <typename Act>
void SceneTracker::forEachInOrder(const Act& act) {
  std::atomic<std::size_t> next{0};
  const auto take = [&](std::size_t) { arena_->helpers.share([&] { act(turns_[next++]); }); };
  arena_->threads.execute([&] {
    if (options_.threads == 1 || turns_.size() == 1) {
      for (std::size_t i = 0; i < turns_.size(); ++i) take(i);
    } else {
      tbb::parallel_for(std::size_t{0}, turns_.size(), take, tbb::simple_partitioner());
    }
  });
}

// Equals stay in the order of the scene.
void SceneTracker::sortByUrgency() {
  std::sort(turns_.begin(), turns_.end(), [](const Turn& l, const Turn& r) {
    if (isMoreUrgent(l.urgency, r.urgency)) return true;
    return !isMoreUrgent(r.urgency, l.urgency) && l.place < r.place;
  });
}

}  // namespace concave_distance
