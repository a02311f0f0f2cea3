#include "concave_distance/scene/tracked_pair.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "base/constants.h"
#include "cloud_bodies.h"
#include "concave_distance/scene/broad_phase.h"
#include "niche_preparation.h"

namespace concave_distance {
namespace {

constexpr double kLeastExpected = 1e-4;  // s that a pair is expected to take after its first cycles

bool isPlacedAnew(const SceneBody& before, const SceneBody& now) {
  return before.frame != now.frame || before.frame_from_body.matrix() != now.frame_from_body.matrix();
}

}  // namespace

TrackedPair::TrackedPair(const Scene& scene, std::size_t index, std::uint64_t first_id)
    : TrackedPair(scene.pairs.share(index), scene.bodies.share(scene.pairs[index].body_a),
                  scene.bodies.share(scene.pairs[index].body_b), first_id) {}

TrackedPair::TrackedPair(std::shared_ptr<const ScenePair> pair, std::shared_ptr<const SceneBody> a,
                         std::shared_ptr<const SceneBody> b, std::uint64_t first_id)
    : origin(std::move(pair)),
      body_a(std::move(a)),
      body_b(std::move(b)),
      effects(body_a->mesh, body_b->mesh, inContact(body_a->material, body_b->material)),
      largest_id(first_id) {
  takeSettings();
}

void TrackedPair::takeSettings() {
  settings = origin->settings;
  settings.tracker = withMargins(settings.tracker, *body_a, *body_b);
  if (preparation && !preparation->suffices(settings.tracker)) preparation.reset();
}

bool TrackedPair::locate(const PairInput& next, const std::atomic<bool>* stop) {
  const bool was_solved = solved();
  input = next;
  repeated = false;
  box_bound.reset();
  if (!input.located) {
    endWithoutAnswer(PairState::NotLocated);
    return false;
  }
  if (detail::isEmptyCloud(*body_a) || detail::isEmptyCloud(*body_b)) {
    stayBeyond(kInfinity);
    return false;
  }
  if (std::isfinite(settings.tracker.cutoff)) {
    const double bound =
        distanceLowerBound(body_a->bounds, body_b->bounds, input.a_from_b, settings.tracker.margin());
    if (bound > settings.tracker.cutoff) {
      stayBeyond(bound);
      return false;
    }
  }
  beyond_since_.reset();
  prepare(stop);
  const bool same_input = input.fixed ? solved_input_.a_from_b.matrix() == input.a_from_b.matrix()
                                      : solved_input_.time == input.time;
  repeated = was_solved && same_input && !must_solve_;
  return !repeated;
}

// Its niches are kept for a while, in case that it comes back.
void TrackedPair::stayBeyond(double bound) {
  constexpr double kKeptSeconds = 2.0;
  if (!beyond_since_) beyond_since_ = input.time;
  if (!(std::abs(input.time - *beyond_since_) <= kKeptSeconds) && tracker_) tracker_->reset();
  effects.reset();
  must_solve_ = true;
  box_bound = bound;
  endWithoutAnswer(PairState::BeyondCutoff);
}

void TrackedPair::solve() {
  tracker_->update(input.a_from_b, input.time, solution);
  put_off = false;
  if (effects.contacts() != nullptr) updateEffects(remainingWork(settings.tracker, solution.solve_seconds));
  endSolve();
}

void TrackedPair::prove(WorkLimit::Clock::time_point cycle_end) {
  needs_niches_ = tracker_->prove(input.a_from_b, input.time, solution, cycle_end);
  is_proof_cut_ = solution.status == SolveStatus::BudgetExhausted && !(WorkLimit::Clock::now() < cycle_end);
}

void TrackedPair::finish(WorkLimit::Clock::time_point end) {
  using Clock = WorkLimit::Clock;
  const Clock::time_point start = Clock::now();
  put_off = is_proof_cut_;
  if (needs_niches_ && start < end) {
    put_off = !tracker_->addNiches(solution, end) || put_off;
  } else if (needs_niches_) {
    tracker_->putOffNiches(solution);
    put_off = true;
  }
  if (effects.contacts() != nullptr) {
    const double own = settings.tracker.time_budget - solution.solve_seconds;
    const Clock::time_point now = Clock::now();
    const double left = std::chrono::duration<double>(end - now).count();
    updateEffects(left < own ? WorkLimit(now, left, settings.tracker.facet_pair_limit, settings.tracker.stop)
                             : remainingWork(settings.tracker, solution.solve_seconds));
    put_off = put_off || (left < own && effects.contacts()->cut);
  }
  endSolve();
  cycles_unfinished = put_off ? cycles_unfinished + 1 : 0;
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  if (put_off) {
    seconds_to_finish = std::max(seconds_to_finish, seconds);
    return;
  }
  // A long one is rarely followed by another.
  seconds_to_finish = std::min(seconds, std::max(kLeastExpected, 2.0 * seconds_to_finish));
}

void TrackedPair::endSolve() {
  solved_input_ = input;
  state = PairState::Solved;
  must_solve_ = put_off;
  for (const TrackedNiche& niche : solution.niches) largest_id = std::max(largest_id, niche.id);
}

void TrackedPair::updateEffects(WorkLimit limit) {
  const double step = input.step.value_or(input.time - solved_input_.time);
  effects.update(solution, step, input.b_in_a, limit);
}

void TrackedPair::watchWarning() {
  warning_changed = false;
  if (!settings.warning_distance) {
    // Removed while it ran: a raised alert is cleared.
    warning_changed = warning.state() != WarningState::Clear;
    warning.reset();
    return;
  }
  std::optional<double> distance = box_bound;
  if (solved() && !std::isnan(solution.distance)) distance = solution.distance;
  warning_changed = warning.update(distance, *settings.warning_distance, settings.warning_hysteresis);
}

void TrackedPair::stop() {
  endWithoutAnswer(PairState::Stopped);
}

// Clears the old answer, so that no caller reads it as the new one; buffers are kept.
void TrackedPair::endWithoutAnswer(PairState now) {
  if (solved()) {
    std::vector<TrackedNiche> niches = std::move(solution.niches);
    std::vector<NicheEvent> events = std::move(solution.events);
    niches.clear();
    events.clear();
    solution = PairSolution();
    solution.niches = std::move(niches);
    solution.events = std::move(events);
    effects.forgetAnswer();
  }
  state = now;
  put_off = false;
  cycles_put_off = cycles_unfinished = 0;
}

bool TrackedPair::needsSearch() const {
  return must_solve_ && ((demand.niches && !isSearchHeld()) || !provesDistance(settings.tracker.accuracy));
}

// A cycle does not make what the background makes.
bool TrackedPair::isSearchHeld() const {
  return preparation && !preparation->isSearchDone();
}

void TrackedPair::restart() {
  if (tracker_) tracker_->reset();
  effects.reset();
  endWithoutAnswer(PairState::NotWatched);
  must_solve_ = true;
}

void TrackedPair::stopWatching() {
  restart();
  effects.prepare(settings.effects, false);
  warning_changed = warning.state() != WarningState::Clear;
  warning.reset();
}

void TrackedPair::discard() {
  tracker_.reset();
  effects.prepare(settings.effects, false);
  endWithoutAnswer(PairState::NotWatched);
  must_solve_ = true;
}

void TrackedPair::adopt(std::shared_ptr<const ScenePair> pair, std::shared_ptr<const SceneBody> a,
                        std::shared_ptr<const SceneBody> b, bool settings_changed) {
  const double margin = settings.tracker.margin();
  // The edit may have placed one anew, at the time of the last answer.
  must_solve_ = must_solve_ || isPlacedAnew(*body_a, *a) || isPlacedAnew(*body_b, *b);
  origin = std::move(pair);
  body_a = std::move(a);
  body_b = std::move(b);
  takeSettings();
  stale_parameters_ = stale_parameters_ || settings_changed || margin != settings.tracker.margin();
}

// Gives tracker and effects what the settings and the demand say; makes them when there are none.
void TrackedPair::prepare(const std::atomic<bool>* stop) {
  if (effects.prepare(settings.effects, demand.effects)) must_solve_ = true;
  if (tracker_) tracker_->holdSearch(isSearchHeld());
  if (tracker_ && !stale_parameters_ && tracker_->parameters().niches_wanted == demand.niches) return;
  TrackerParameters parameters = settings.tracker;
  parameters.niches_wanted = demand.niches;
  parameters.stop = stop;
  if (tracker_) {
    tracker_->setParameters(parameters);
  } else {
    tracker_ =
        std::make_unique<PairTracker>(origin->name, body_a->mesh, body_b->mesh, parameters, largest_id);
    tracker_->holdSearch(isSearchHeld());
  }
  stale_parameters_ = false;
  must_solve_ = true;
}

}  // namespace concave_distance
