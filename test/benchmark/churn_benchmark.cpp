// A scene that lives: a hundred changes a second for as long as is asked for, while a cycle with niches runs
// 50 times a second, as in the node: edits in one thread, cycles in another, bodies prepared in the
// background.
//
//   churn_benchmark [--seconds 600] [--bodies 200] [--changes 100] [--new-meshes 20] [--threads 0] [--seed 1]
//                   [--output doc/results/churn.csv]
//
// Half of the bodies follow frames on smooth paths (scene_benchmark's), half are boxes, balls and meshes that
// edits move, attach, detach, remove and add; of the changes so many a second add a mesh of 1,000 triangles
// that never was there, the others that add take one of 20 shapes. A row is a tenth of the time: bodies and
// near pairs at its end; changes a second by kind; cycles and the share that end more than 20 ms after their
// time; milliseconds of a cycle and of an edit until it is answered (median, 99th percentile, largest); pairs
// that wait for their bodies to be prepared (mean) and the longest such wait, milliseconds; resident memory
// at its end, MB; milliseconds of a batch that adds 100 bodies of known shapes, loading included. Every five
// seconds the scene stands still and is compared with one that is tracked from nothing: answers compared and
// those that differ by more than 1e-9 m; complete lists compared and those that differ; pairs of a body that
// is then attached or detached, and those of which an id is lost.
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <map>
#include <mutex>
#include <thread>

#include "base/random_engine.h"
#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/living_scene.h"
#include "benchmark/support/program_options.h"
#include "benchmark/support/resident_memory.h"
#include "benchmark/support/result_table.h"
#include "benchmark/support/statistics.h"
#include "benchmark/support/stopwatch.h"
#include "concave_distance/scene/scene_tracker.h"

namespace concave_distance::benchmark {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kPeriod = 0.02;
constexpr double kBudget = 0.8 * kPeriod;
constexpr double kAuditPeriod = 5.0;  // seconds
constexpr int kRows = 10;
constexpr PairDemand kNiches{true, true, true, false};

/// Holds what one tenth of the time has shown.
struct Row {
  std::array<std::uint64_t, kChangeKinds> changes{};
  std::vector<double> edit_ms;
  std::vector<double> cycle_ms;
  std::uint64_t late = 0;
  std::vector<double> unprepared;
  double longest_wait_ms = 0.0;
  double batch_ms = 0.0;
  double seconds = 0.0;  ///< without those of the audits
  std::uint64_t answers = 0;
  std::uint64_t wrong_answers = 0;
  std::uint64_t lists = 0;
  std::uint64_t wrong_lists = 0;
  std::uint64_t kept_pairs = 0;
  std::uint64_t lost_ids = 0;
};

using PairKey = std::pair<std::uint64_t, std::uint64_t>;

std::map<PairKey, const TrackedPair*> pairsOf(const SceneTracker& tracker) {
  std::map<PairKey, const TrackedPair*> pairs;
  for (const auto& pair : tracker.pairs()) {
    if (pair->solved()) pairs[std::minmax(pair->body_a->serial, pair->body_b->serial)] = pair.get();
  }
  return pairs;
}

std::vector<double> distancesOf(const PairSolution& solution) {
  std::vector<double> distances;
  for (const TrackedNiche& niche : solution.niches) distances.push_back(niche.distance);
  std::sort(distances.begin(), distances.end());
  return distances;
}

std::vector<std::uint64_t> idsOf(const PairSolution& solution) {
  std::vector<std::uint64_t> ids;
  for (const TrackedNiche& niche : solution.niches) ids.push_back(niche.id);
  std::sort(ids.begin(), ids.end());
  return ids;
}

/// The cycles of a scene that another thread edits.
class Churn {
 public:
  Churn(const ChurnOptions& options, std::uint32_t threads)
      : living_(options), threads_(threads), tracker_(trackerOptions(threads)) {
    follow();
  }
  ~Churn() {
    ends_ = true;
    wake_.notify_all();
    if (editor_.joinable()) editor_.join();
  }

  Row run(double seconds) {
    if (!editor_.joinable()) editor_ = std::thread([this] { editAll(); });
    Row row;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      row.batch_ms = living_.timeABatch(time_);
    }
    const auto begin = Clock::now();
    double still = 0.0;  // spent in audits
    auto next = Clock::now();
    double next_audit = kAuditPeriod;
    runs_ = true;
    wake_.notify_all();
    while (1e-6 * microsecondsSince(begin) - still < seconds) {
      next += std::chrono::microseconds(static_cast<int>(1e6 * kPeriod));
      std::this_thread::sleep_until(next);
      time_ = time_ + kPeriod;
      row.cycle_ms.push_back(millisecondsOf([&] { cycle(instantIn(kBudget)); }));
      row.late += 1e-3 * microsecondsSince(next) > 1e3 * kPeriod ? 1 : 0;
      // A cycle that overruns moves the next ones, as the node's timer does.
      next = std::max(next, Clock::now() - std::chrono::microseconds(static_cast<int>(1e6 * kPeriod)));
      watchPreparation(row);
      if (1e-6 * microsecondsSince(begin) - still < next_audit) continue;
      still += 1e-3 * millisecondsOf([&] { audit(row); });
      next = Clock::now();
      next_audit += kAuditPeriod;
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    runs_ = false;
    row.seconds = 1e-6 * microsecondsSince(begin) - still;
    row.changes = std::exchange(changes_, {});
    row.edit_ms = std::exchange(edit_ms_, {});
    return row;
  }

  std::size_t bodies() const { return living_.scene()->bodies.size(); }
  std::size_t pairs() const { return tracker_.pairs().size(); }

 private:
  static SceneTrackerOptions trackerOptions(std::uint32_t threads) {
    SceneTrackerOptions options{threads, nullptr};
    options.prepares_in_background = true;
    return options;
  }

  // The other thread: a change at a time, at the pace that is asked for.
  void editAll() {
    auto next = Clock::now();
    const auto pause =
        std::chrono::microseconds(static_cast<int>(1e6 / static_cast<double>(living_.options().changes)));
    std::unique_lock<std::mutex> lock(mutex_);
    while (!ends_) {
      if (!runs_) {
        wake_.wait(lock, [this] { return runs_ || ends_; });
        next = Clock::now();
      }
      lock.unlock();
      next += pause;
      std::this_thread::sleep_until(next);
      lock.lock();
      next = std::max(next, Clock::now() - pause);  // what could not be done in time is left out
      if (!runs_ || ends_) continue;
      Change change;
      edit_ms_.push_back(millisecondsOf([&] { change = living_.change(time_); }));
      ++changes_[static_cast<std::size_t>(change)];
    }
  }

  // The node does the same: it takes the newest scene, then runs a cycle.
  void cycle(Clock::time_point end) {
    follow();
    counts_ = tracker_.update(living_.posesOf(*followed_, time_), time_, kNiches, end);
  }
  void follow() {
    std::shared_ptr<const Scene> newest = living_.scene();
    if (newest == followed_) return;
    tracker_.setScene(*newest, false);
    followed_ = std::move(newest);
  }

  void watchPreparation(Row& row) {
    row.unprepared.push_back(counts_.unprepared);
    const auto now = Clock::now();
    waiting_before_.swap(waiting_);
    waiting_.clear();
    for (const auto& pair : tracker_.pairs()) {
      if (!pair->demand.watched || pair->demand.niches) continue;
      const auto before = waiting_before_.find(pair.get());
      const auto since = before == waiting_before_.end() ? now : before->second;
      waiting_.emplace(pair.get(), since);
      row.longest_wait_ms = std::max(row.longest_wait_ms, 1e-3 * microsecondsSince(since));
    }
  }

  // The scene stands still: cycles without an end, an edit that moves nothing, and a tracker that knows
  // nothing.
  void audit(Row& row) {
    const std::lock_guard<std::mutex> lock(mutex_);
    cycle(kNoCycleEnd);
    std::map<PairKey, std::pair<const TrackedPair*, PairSolution>> before;
    for (const auto& [key, pair] : pairsOf(tracker_)) before[key] = {pair, pair->solution};
    living_.attachOrDetach(time_);
    cycle(kNoCycleEnd);
    const auto now = pairsOf(tracker_);
    for (const auto& [key, pair] : now) {
      const auto found = before.find(key);
      if (found == before.end()) continue;
      ++row.kept_pairs;
      const PairSolution& old = found->second.second;
      const bool both_complete = old.niches_complete && pair->solution.niches_complete;
      const bool has_ids = !both_complete || idsOf(old) == idsOf(pair->solution);
      row.lost_ids += found->second.first == pair && has_ids ? 0 : 1;
    }
    SceneTracker fresh({threads_, nullptr});
    fresh.setScene(*followed_);
    fresh.update(living_.posesOf(*followed_, time_), time_, kNiches);
    const auto expected = pairsOf(fresh);
    const auto isNear = [](const TrackedPair* pair) { return pair->solution.distance <= kCutoff; };
    for (const auto& [key, pair] : expected) {
      if (!isNear(pair)) continue;
      ++row.answers;
      row.wrong_answers += now.count(key) == 0 ? 1 : 0;
    }
    for (const auto& [key, pair] : now) {
      const auto other = expected.find(key);
      if (other == expected.end()) {
        row.wrong_answers += isNear(pair) ? 1 : 0;
        continue;
      }
      compare(pair->solution, other->second->solution, row);
    }
  }

  static void compare(const PairSolution& own, const PairSolution& fresh, Row& row) {
    constexpr double kTolerance = 1e-9;  // metres
    row.wrong_answers += std::abs(own.distance - fresh.distance) <= kTolerance ? 0 : 1;
    if (!own.niches_complete || !fresh.niches_complete) return;
    ++row.lists;
    const std::vector<double> l = distancesOf(own);
    const std::vector<double> r = distancesOf(fresh);
    const bool is_equal = std::equal(l.begin(), l.end(), r.begin(), r.end(),
                                     [](double a, double b) { return std::abs(a - b) <= kTolerance; });
    row.wrong_lists += is_equal ? 0 : 1;
  }

  LivingScene living_;
  std::uint32_t threads_;
  SceneTracker tracker_;
  std::shared_ptr<const Scene> followed_;
  CycleCounts counts_;
  std::map<const TrackedPair*, Clock::time_point> waiting_;
  std::map<const TrackedPair*, Clock::time_point> waiting_before_;
  std::atomic<double> time_{0.0};  ///< seconds, of the paths
  std::mutex mutex_;               ///< guards edits and what follows
  std::condition_variable wake_;
  std::array<std::uint64_t, kChangeKinds> changes_{};
  std::vector<double> edit_ms_;
  std::atomic<bool> runs_{false};
  std::atomic<bool> ends_{false};
  std::thread editor_;
};

}  // namespace

int benchmarkMain(int argc, char** argv) {
  ProgramOptions options("A scene that changes a hundred times a second");
  double seconds = 600.0;
  ChurnOptions churn_options;
  std::uint32_t threads = 0;
  options.add("--seconds", seconds, "Of wall time, without those in which the scene is compared", 1.0);
  options.add("--bodies", churn_options.bodies, "About so many at any time", std::size_t{40});
  options.add("--changes", churn_options.changes, "A second", std::size_t{1});
  options.add("--new-meshes", churn_options.new_meshes, "Of these, a second");
  options.add("--threads", threads, "Threads that solve pairs; 0: one per core");
  options.add("--seed", churn_options.seed, "Of the changes");
  if (!options.read(argc, argv)) return options.status();

  ResultTable table(
      options.output(),
      "tenth,bodies,near_pairs,moves_s,attaches_s,detaches_s,removes_s,adds_s,new_meshes_s,cycles,"
      "late,cycle_ms,cycle_p99_ms,cycle_largest_ms,edit_ms,edit_p99_ms,edit_largest_ms,"
      "unprepared_pairs,longest_wait_ms,memory_mb,batch_ms,answers,answers_wrong,lists,lists_wrong,"
      "pairs_kept,ids_lost");
  Churn churn(churn_options, threads);
  for (int tenth = 1; tenth <= kRows; ++tenth) {
    const Row row = churn.run(seconds / kRows);
    const auto rate = [&](Change kind) {
      return static_cast<double>(row.changes[static_cast<std::size_t>(kind)]) / row.seconds;
    };
    table.add(tenth, churn.bodies(), churn.pairs(), rate(Change::Move), rate(Change::Attach),
              rate(Change::Detach), rate(Change::Remove), rate(Change::Add), rate(Change::AddNew),
              row.cycle_ms.size(), static_cast<double>(row.late) / static_cast<double>(row.cycle_ms.size()),
              median(row.cycle_ms), percentile(row.cycle_ms, 0.99), percentile(row.cycle_ms, 1.0),
              median(row.edit_ms), percentile(row.edit_ms, 0.99), percentile(row.edit_ms, 1.0),
              mean(row.unprepared), row.longest_wait_ms, residentMegabytes("VmRSS"), row.batch_ms,
              row.answers, row.wrong_answers, row.lists, row.wrong_lists, row.kept_pairs, row.lost_ids);
  }
  return 0;
}

}  // namespace concave_distance::benchmark
