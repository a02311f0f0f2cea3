#include "cycle_solver.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "concave_distance/search/prepare_search.h"
#include "solver_threads.h"

namespace concave_distance {
namespace {

/// A list that stays unfinished has a cycle of its own in every so many: it leaves no time to those after it.
constexpr std::uint32_t kCyclesToOwnOne = 4;
/// A list that is expected to need this share of the time for all lists is a long one.
constexpr double kShareOfLong = 0.125;

bool ownsCycle(const TrackedPair& pair) {
  return pair.cycles_unfinished % kCyclesToOwnOne == kCyclesToOwnOne - 1;
}

}  // namespace

CycleSolver::CycleSolver(std::uint32_t threads, const std::atomic<bool>* stop)
    : is_serial_(threads == 1), stop_(stop), arena_(makeSolverArena(threads)) {}

void CycleSolver::reserve(std::size_t pairs) {
  pairs_.reserve(pairs);
  turns_.reserve(pairs);
}

// Grids and metrics of bodies whose niches are searched for the first time are made together, in parallel.
void CycleSolver::begin(const std::vector<TrackedPair*>& pairs) {
  team_.begin();
  pairs_.assign(pairs.begin(), pairs.end());
  if (isStopped()) return;
  to_prepare_.clear();
  for (const TrackedPair* pair : pairs_) {
    if (!pair->needsSearch()) continue;
    for (const BodyMesh* body : {pair->body_a->mesh.get(), pair->body_b->mesh.get()}) {
      if (!searchPreparationOf(body->asSolved()).is_complete) to_prepare_.push_back(&body->asSolved());
    }
  }
  if (!to_prepare_.empty()) {
    arena_.execute([&] { prepareSearch(to_prepare_); });
  }
}

// One piece of work, too, is done in the arena: long ones use its idle threads.
template <typename Act>
void CycleSolver::forEach(std::size_t count, const Act& act) {
  if (count == 0) return;
  const auto shared = [&](std::size_t index) { team_.share([&] { act(index); }); };
  arena_.execute([&] {
    if (is_serial_ || count == 1) {
      for (std::size_t index = 0; index < count; ++index) shared(index);
    } else {
      tbb::parallel_for(std::size_t{0}, count, shared, tbb::simple_partitioner());
    }
  });
}

void CycleSolver::solveAll() {
  forEach(pairs_.size(), [&](std::size_t index) { solve(*pairs_[index]); });
}

void CycleSolver::solve(TrackedPair& pair) {
  if (isStopped()) {
    pair.stop();
    return;
  }
  pair.solve();
}

// Two rounds in the order of urgency: the distances, so that each has its proof before any list takes its
// time, then niches and effects, long lists last. A pair leaves those after it what they needed last, but
// takes half of what is left at least, so that a list which needs long does not wait for ever.
void CycleSolver::solveUntil(WorkLimit::Clock::time_point end) {
  using Clock = WorkLimit::Clock;
  using Seconds = std::chrono::duration<double>;
  if (isStopped()) {
    for (TrackedPair* pair : pairs_) pair->stop();
    return;
  }
  turns_.clear();
  for (TrackedPair* pair : pairs_) {
    const PairSolution& last = pair->solution;
    turns_.push_back(
        {pair, turns_.size(), {last.distance, last.closing_speed, pair->cycles_put_off, false, false}, 0.0});
  }
  sortByUrgency();
  forEachInOrder([&](Turn& turn) {
    turn.pair->prove(end);
    const PairSolution& now = turn.pair->solution;
    if (std::isnan(now.distance)) return;  // of a level that proves none
    turn.urgency.distance = now.distance;
    turn.urgency.closing_speed = now.closing_speed;
  });
  const double all = Seconds(end - Clock::now()).count();
  for (Turn& turn : turns_) {
    turn.urgency.is_long = turn.pair->seconds_to_finish > kShareOfLong * all;
    turn.urgency.owns_cycle = turn.urgency.is_long && ownsCycle(*turn.pair);
    turn.urgency.is_last = turn.pair->demand.niches_last;
  }
  sortByUrgency();
  const auto threads = static_cast<double>(arena_.max_concurrency());
  giveThread(0.5 * (threads - 1.0) * all);
  double seconds_after = 0.0;
  for (std::size_t i = turns_.size(); i-- > 0;) {
    const bool is_before_last =
        i + 1 < turns_.size() && turns_[i + 1].urgency.is_last && !turns_[i].urgency.is_last;
    if (is_before_last) seconds_after = 0.0;  // what comes last is left nothing
    turns_[i].seconds_after = seconds_after;
    seconds_after += turns_[i].pair->seconds_to_finish;
  }
  forEachInOrder([&](Turn& turn) {
    TrackedPair& pair = *turn.pair;
    const Clock::time_point now = Clock::now();
    const double left = Seconds(end - now).count();
    const double after = turn.urgency.owns_cycle ? 0.0 : turn.seconds_after / threads;
    const double own = std::max(0.5 * left, left - after);
    pair.finish(now + std::chrono::duration_cast<Clock::duration>(Seconds(own)));
    const bool had_its_turn = own > 0.0 && own >= 0.5 * all;
    pair.cycles_put_off = pair.put_off && !had_its_turn ? pair.cycles_put_off + 1 : 0;
  });
}

// Where the other threads have time for all short lists, the long one that has waited longest goes first.
void CycleSolver::giveThread(double seconds_of_others) {
  double seconds = 0.0;
  auto first = turns_.end();
  for (auto turn = turns_.begin(); turn != turns_.end() && !turn->urgency.is_last; ++turn) {
    if (!turn->urgency.is_long) {
      seconds += turn->pair->seconds_to_finish;
    } else if (first == turns_.end() || first->pair->cycles_unfinished < turn->pair->cycles_unfinished) {
      first = turn;
    }
  }
  if (first == turns_.end() || seconds > seconds_of_others) return;
  first->urgency.owns_cycle = true;
  std::rotate(turns_.begin(), first, first + 1);
}

// Threads take turns in their order, each the next one.
template <typename Act>
void CycleSolver::forEachInOrder(const Act& act) {
  std::atomic<std::size_t> next{0};
  forEach(turns_.size(), [&](std::size_t) { act(turns_[next++]); });
}

// Equals stay in the order of the scene.
void CycleSolver::sortByUrgency() {
  std::sort(turns_.begin(), turns_.end(), [](const Turn& l, const Turn& r) {
    if (isMoreUrgent(l.urgency, r.urgency)) return true;
    return !isMoreUrgent(r.urgency, l.urgency) && l.place < r.place;
  });
}

}  // namespace concave_distance
