#include "concave_distance/ros/distance_cycle.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <thread>
#include <unordered_map>
#include <utility>

#include "concave_distance/ros/thread_count.h"
#include "concave_distance/ros/thread_cpu.h"
#include "concave_distance/scene/broad_phase.h"

namespace concave_distance {
namespace {

void watchWarning(TrackedPair& pair) {
  pair.warning_changed = false;
  if (!pair.settings.warning_distance) {
    // Removed while it ran: a raised alert is cleared.
    pair.warning_changed = pair.warning.state() != WarningState::Clear;
    pair.warning.reset();
    pair.heading.warning = false;
    return;
  }
  std::optional<double> distance;
  if (pair.solved && !std::isnan(pair.solution.distance)) {
    distance = pair.solution.distance;
  } else if (pair.box_bound) {
    distance = pair.box_bound;
  }
  pair.warning_changed =
      pair.warning.update(distance, *pair.settings.warning_distance, pair.settings.warning_hysteresis);
  pair.heading.warning = pair.warning.state() == WarningState::Warning;
}

constexpr std::size_t kNowhere = std::numeric_limits<std::size_t>::max();

// An edit shares the bodies that it leaves as they are.
bool isOfTheSameBodies(const TrackedPair& tracked, const Scene& scene, const ScenePair& wanted) {
  return tracked.body_a.get() == &scene.bodies[wanted.body_a] &&
         tracked.body_b.get() == &scene.bodies[wanted.body_b];
}

}  // namespace

DistanceCycle::DistanceCycle(const TransformBuffer& transforms, CycleOptions options)
    : transforms_(transforms), options_(std::move(options)), arena_(makeCycleArena(options_.threads)) {}

// Of each pair of the scene: where it is in pairs_, or kNowhere when it is new.
std::vector<std::size_t> DistanceCycle::placesNow(const Scene& scene) const {
  std::vector<std::size_t> places(scene.pairs.size(), kNowhere);
  // Usually an edit leaves most pairs as they are, in their places.
  std::unordered_map<std::string_view, std::size_t> moved;
  for (std::size_t index = 0; index < pairs_.size(); ++index) {
    if (index < places.size() && pairs_[index]->origin.get() == &scene.pairs[index]) {
      places[index] = index;
    } else {
      moved.emplace(pairs_[index]->heading.pair, index);
    }
  }
  for (std::size_t index = 0; index < places.size(); ++index) {
    if (places[index] != kNowhere) continue;
    const ScenePair& wanted = scene.pairs[index];
    const auto found = moved.find(wanted.name);
    if (found != moved.end() && isOfTheSameBodies(*pairs_[found->second], scene, wanted)) {
      places[index] = found->second;
    }
  }
  return places;
}

void DistanceCycle::setScene(const Scene& scene, bool settings_changed) {
  const std::vector<std::size_t> places = placesNow(scene);
  std::vector<bool> stays(pairs_.size(), false);
  for (const std::size_t place : places) {
    if (place != kNowhere) stays[place] = true;
  }
  // Ids are not used again: pairs that come later begin above all that are gone.
  std::uint64_t largest_retired_id = largest_retired_id_;
  std::vector<std::size_t> to_retire;
  for (std::size_t place = 0; place < pairs_.size(); ++place) {
    if (stays[place]) continue;
    largest_retired_id = std::max(largest_retired_id, pairs_[place]->largest_id);
    if (pairs_[place]->warning.state() != WarningState::Clear) to_retire.push_back(place);
  }
  std::vector<std::unique_ptr<TrackedPair>> next(places.size());
  for (std::size_t index = 0; index < places.size(); ++index) {
    if (places[index] == kNowhere) {
      next[index] = std::make_unique<TrackedPair>(scene, index, options_.reference_frame, largest_retired_id);
    }
  }
  retired_.reserve(retired_.size() + to_retire.size());
  for (const std::size_t place : to_retire) {
    pairs_[place]->status.message = "the pair was removed with one of its bodies";
  }

  // Nothing below allocates.
  for (std::size_t index = 0; index < places.size(); ++index) {
    if (places[index] == kNowhere) continue;
    next[index] = std::move(pairs_[places[index]]);
    TrackedPair& pair = *next[index];
    if (pair.origin.get() == &scene.pairs[index]) continue;
    pair.origin = scene.pairs.share(index);
    pair.settings = pair.origin->settings;
    pair.enabled = pair.origin->enabled;
    pair.stale_parameters = pair.stale_parameters || settings_changed;
  }
  for (const std::size_t place : to_retire) {
    stopWatching(*pairs_[place]);
    retired_.push_back(std::move(pairs_[place]));
  }
  pairs_ = std::move(next);
  largest_retired_id_ = largest_retired_id;
}

std::vector<std::unique_ptr<TrackedPair>> DistanceCycle::takeRetired() {
  return std::exchange(retired_, {});
}

// An alert that is raised when nobody watches the pair any more is taken back: it would never end.
void DistanceCycle::stopWatching(TrackedPair& pair) {
  pair.restart();
  pair.effects.prepare(pair.settings.effects, false);
  pair.status.code = PairStatus::DISABLED;
  pair.warning_changed = pair.warning.state() != WarningState::Clear;
  pair.warning.reset();
  pair.heading.warning = false;
}

void DistanceCycle::restart() {
  for (auto& pair : pairs_) {
    pair->restart();
  }
}

void DistanceCycle::restart(std::size_t pair) {
  pairs_[pair]->restart();
}

CycleReport DistanceCycle::run(const std::vector<PairDemand>& demand, ros::Time now) {
  if (std::exchange(interrupted_, true)) {
    for (auto& pair : pairs_) {
      pair->discard();
    }
  }
  const std::shared_ptr<const tf2::BufferCore> buffer = transforms_.current();
  CycleReport report;
  to_solve_.clear();
  for (std::size_t index = 0; index < pairs_.size(); ++index) {
    TrackedPair& pair = *pairs_[index];
    const bool was_watched = pair.demand.watched;
    pair.demand = pair.enabled ? demand[index] : PairDemand{};
    if (!pair.demand.watched) {
      pair.warning_changed = false;
      if (was_watched) {
        pair.status.message = pair.enabled ? "nobody subscribes" : "the pair was switched off";
        stopWatching(pair);
      }
      continue;
    }
    ++report.watched;
    if (pair.demand.due && locate(pair, *buffer, now)) {
      to_solve_.push_back(&pair);
    }
  }
  helper_cpu_nanoseconds_ = 0;
  prepareSearches();
  solveAll();
  for (auto& pair : pairs_) {
    if (!pair->demand.due) {
      continue;
    }
    watchWarning(*pair);
    report.repeated += pair->repeated ? 1 : 0;
    report.beyond_cutoff += pair->status.code == PairStatus::BEYOND_CUTOFF ? 1 : 0;
    report.without_transform +=
        pair->status.code == PairStatus::MISSING_TRANSFORM || pair->status.code == PairStatus::STALE_TRANSFORM
            ? 1
            : 0;
  }
  for (TrackedPair* pair : to_solve_) {
    ++report.solved;
    report.effects += pair->effects.takeCounts();
    report.cold += pair->solution.warm ? 0 : 1;
    report.search_misses += pair->solution.search_miss ? 1 : 0;
    const SolveStatus status = pair->solution.status;
    report.unproven +=
        status == SolveStatus::BudgetExhausted || status == SolveStatus::MemoryExhausted ? 1 : 0;
  }
  report.helper_cpu_seconds = 1e-9 * static_cast<double>(helper_cpu_nanoseconds_.load());
  interrupted_ = false;
  return report;
}

// Fills status, stamp and poses; true when the pair has to be solved.
bool DistanceCycle::locate(TrackedPair& pair, const tf2::BufferCore& buffer, ros::Time now) {
  PairTransforms transforms = lookUpPair(buffer, pair.frames, now, options_.stale_after, pair.ancestors);
  pair.repeated = false;
  pair.box_bound.reset();
  const ros::Time last_stamp = pair.heading.stamp;
  pair.heading.with_niches = pair.demand.niches;
  pair.heading.stamp = transforms.status == TransformStatus::Missing ? now : transforms.stamp;
  pair.status = toStatus(transforms.status, transforms.message);
  if (transforms.status != TransformStatus::Ok) {
    pair.solved = false;
    return false;
  }
  pair.heading.reference_from_a = transforms.reference_from_a;
  pair.located_a_from_b = transforms.a_from_b;
  pair.fixed = transforms.fixed;
  const double cutoff = pair.settings.tracker.cutoff;
  if (std::isfinite(cutoff)) {
    const double bound = distanceLowerBound(pair.body_a->bounds, pair.body_b->bounds, transforms.a_from_b);
    if (bound > cutoff) {
      pair.restart();
      pair.box_bound = bound;
      pair.status.code = PairStatus::BEYOND_CUTOFF;
      return false;
    }
  }
  pair.prepare(options_.stop);
  const bool same_input = transforms.fixed ? pair.solved_a_from_b.matrix() == transforms.a_from_b.matrix()
                                           : last_stamp == transforms.stamp;
  pair.repeated = pair.solved && same_input && !pair.must_solve;
  if (pair.repeated) {
    return false;
  }
  pair.solved_a_from_b = transforms.a_from_b;
  return true;
}

// Grids and metrics of bodies whose niches are searched for the first time are made together, in parallel.
void DistanceCycle::prepareSearches() {
  if (options_.stop != nullptr && *options_.stop) return;
  to_prepare_.clear();
  for (const TrackedPair* pair : to_solve_) {
    if (!pair->must_solve || (!pair->demand.niches && provesDistance(pair->settings.tracker.accuracy))) {
      continue;
    }
    for (const BodyMesh* body : {pair->body_a->mesh.get(), pair->body_b->mesh.get()}) {
      if (body->metricIfMade() == nullptr) {
        to_prepare_.push_back(body);
      }
    }
  }
  if (!to_prepare_.empty()) {
    arena_.execute([&] { prepareSearch(to_prepare_); });
  }
}

void DistanceCycle::solveAll() {
  if (options_.threads == 1 || to_solve_.size() < 2) {
    for (TrackedPair* pair : to_solve_) {
      solve(*pair);
    }
    return;
  }
  const std::thread::id caller = std::this_thread::get_id();
  arena_.execute([&] {
    tbb::parallel_for(
        std::size_t{0}, to_solve_.size(),
        [&](std::size_t index) {
          const std::int64_t start = threadCpuNanoseconds();
          solve(*to_solve_[index]);
          if (std::this_thread::get_id() != caller) {
            helper_cpu_nanoseconds_ += threadCpuNanoseconds() - start;
          }
        },
        tbb::simple_partitioner());
  });
}

void DistanceCycle::solve(TrackedPair& pair) {
  if (options_.stop != nullptr && *options_.stop) {
    pair.solved = false;
    pair.status.code = PairStatus::DISABLED;
    pair.status.message = "the node is shutting down";
    return;
  }
  pair.tracker->update(pair.solved_a_from_b, pair.heading.stamp.toSec(), pair.solution);
  WorkLimit limit = remainingWork(pair.settings.tracker, pair.solution.solve_seconds);
  pair.effects.update(pair.solution, pair.solved_a_from_b, pair.heading.stamp, limit);
  pair.solved = true;
  pair.must_solve = false;
  for (const TrackedNiche& niche : pair.solution.niches) {
    pair.largest_id = std::max(pair.largest_id, niche.id + pair.heading.id_offset);
  }
}

}  // namespace concave_distance
