// A control loop that links the tracker: what its cycles take, and what disturbs them.
//
//   control_benchmark [robot] [cell] [ROBOT.urdf[,ROBOT.srdf] ...] [--seconds 60] [--rate 1000] [--threads 1]
//   [--share 0.6] [--distance 0.1] [--slots 64] [--priority 0] [--core -1] [--unprepared] [--output FILE]
//
// The robot moves as in cycle_benchmark, in real time: the loop sleeps until the next period, computes the
// poses of joint positions that it has got before, updates the tracker with every pair's niches and, within
// --distance, makes their rows. --share is the cycle's budget as a share of the period; 0: no end. --priority
// above 0 asks for SCHED_FIFO, --core pins the loop; memory is locked where that is allowed. --unprepared
// leaves SceneTracker::prepare() out. A row is a quantity of the cycles: how late the loop woke, wall time
// and processor time (of its thread) of the work; of operator new, page faults, involuntary and voluntary
// context switches, and lists that the end of the cycle put off, how many in a cycle. It has the quantity's
// median, 99th, 99.9th and 99.99th percentile and largest value, the number of cycles above the period, or
// above none, and the sum. Then the histogram of times, and the cycles with the most processor time.
#include <malloc.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <time.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/moving_scene.h"
#include "benchmark/support/result_table.h"
#include "benchmark/support/statistics.h"
#include "benchmark/support/stopwatch.h"
#include "concave_distance/kinematics/constraint_rows.h"
#include "concave_distance/scene/scene_tracker.h"
#include "support/count_allocations.h"

namespace concave_distance::benchmark {
namespace {

using Clock = WorkLimit::Clock;

struct Settings {
  double seconds = 60.0;
  double rate = 1000.0;
  std::uint32_t threads = 1;
  double share = 0.6;
  ConstraintSettings rows;
  int priority = 0;
  int core = -1;
  bool is_unprepared = false;

  double period() const { return 1.0 / rate; }
};

enum Quantity {
  kWake,
  kCycle,
  kProcessor,
  kRows,
  kAllocations,
  kFaults,
  kPreempted,
  kWaits,
  kPutOff,
  kQuantities
};
constexpr std::array<const char*, kQuantities> kNames{
    "late by (us)",         "cycle (us)", "processor time (us)", "rows (us)", "allocations", "page faults",
    "involuntary switches", "waits",      "lists put off"};
constexpr int kTimes = kRows + 1;  // the first quantities

/// Holds what one cycle takes of each.
using Sample = std::array<float, kQuantities>;

/// Counters of the calling thread.
struct Counters {
  std::size_t allocated = allocations;
  rusage usage{};
  double processor = processorMicroseconds();

  Counters() { getrusage(RUSAGE_THREAD, &usage); }
};

/// Memory that the loop takes comes from a heap that is there already and does not shrink.
void reserveHeap() {
  constexpr std::size_t kBytes = std::size_t{64} << 20U;
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  const std::unique_ptr<char[]> heap(new char[kBytes]);
  for (std::size_t i = 0; i < kBytes; i += 4096) static_cast<volatile char*>(heap.get())[i] = 1;
}

void setUpThread(const Settings& settings) {
  reserveHeap();
  if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0) std::puts("memory is not locked: not allowed");
  if (settings.core >= 0) {
    cpu_set_t cores;
    CPU_ZERO(&cores);
    CPU_SET(static_cast<std::size_t>(settings.core), &cores);
    if (sched_setaffinity(0, sizeof cores, &cores) != 0) std::puts("the loop is not pinned: no such core");
  }
  if (settings.priority > 0) {
    sched_param parameters{};
    parameters.sched_priority = settings.priority;
    if (sched_setscheduler(0, SCHED_FIFO, &parameters) != 0) std::puts("no SCHED_FIFO: not allowed");
  }
}

double sleepUntil(Clock::time_point instant) {
  const auto since = instant.time_since_epoch();
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(since);
  timespec wanted{};
  wanted.tv_sec = seconds.count();
  wanted.tv_nsec = std::chrono::duration_cast<std::chrono::nanoseconds>(since - seconds).count();
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &wanted, nullptr) == EINTR) {
  }
  return microsecondsSince(instant);
}

/// The loop: everything that it needs is made before it begins.
class ControlLoop {
 public:
  ControlLoop(const MovingScene& moving, const Settings& settings)
      : moving_(moving),
        settings_(settings),
        joints_(std::make_shared<const SceneKinematics>(moving.scene)),
        positions_(joints_->restPositions()),
        state_(joints_->startState()),
        tracker_({settings.threads, nullptr}),
        rows_(joints_, settings.rows),
        samples_(static_cast<std::size_t>(std::lround(settings.seconds * settings.rate))) {
    tracker_.setScene(moving.scene);
  }

  void prepare() {
    moving_.move(0.0, *joints_, positions_);
    joints_->evaluate(positions_, state_);
    const double milliseconds = settings_.is_unprepared ? 0.0 : millisecondsOf([&] {
      tracker_.prepare(state_.world_from_body, -settings_.period());
      rows_.update(tracker_.pairs(), state_, -settings_.period());
    });
    std::printf("prepared in %.1f ms\n", milliseconds);
  }

  void run() {
    const auto period =
        std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(settings_.period()));
    Clock::time_point next = Clock::now() + period;
    for (std::size_t cycle = 0; cycle < samples_.size(); ++cycle) {
      const double time = static_cast<double>(cycle) * settings_.period();
      moving_.move(time, *joints_, positions_);
      samples_[cycle][kWake] = static_cast<float>(sleepUntil(next));
      runCycle(time, samples_[cycle]);
      next += period;
      // A loop that is behind leaves periods out.
      while (next < Clock::now()) {
        next += period;
        ++left_out_;
      }
    }
  }

  void report(ResultTable& table) const {
    const double above = 1e6 * settings_.period();
    for (int quantity = 0; quantity < kQuantities; ++quantity) {
      const std::vector<double> values = valuesOf(quantity);
      const double limit = quantity < kTimes ? above : 0.0;
      const auto count =
          std::count_if(values.begin(), values.end(), [&](double value) { return value > limit; });
      table.add(moving_.name, settings_.threads, settings_.priority, values.size(), kNames[quantity],
                percentile(values, 0.5), percentile(values, 0.99), percentile(values, 0.999),
                percentile(values, 0.9999), percentile(values, 1.0), count,
                std::accumulate(values.begin(), values.end(), 0.0));
    }
    const auto cycles = static_cast<double>(samples_.size());
    std::printf(
        "%zu pairs, a cycle %.1f solved, %.1f niches, %.1f rows; periods left out %zu; first cycle %.0f us\n",
        tracker_.pairs().size(), static_cast<double>(total_.solved) / cycles,
        static_cast<double>(niches_) / cycles, static_cast<double>(used_rows_) / cycles, left_out_,
        samples_.front()[kCycle]);
    printHistogram();
    printLongest();
  }

 private:
  void runCycle(double time, Sample& sample) {
    const Counters before;
    const Clock::time_point start = Clock::now();
    joints_->evaluate(positions_, state_);
    const std::chrono::duration<double> budget(settings_.share * settings_.period());
    const Clock::time_point end =
        settings_.share > 0.0 ? start + std::chrono::duration_cast<Clock::duration>(budget) : kNoCycleEnd;
    const CycleCounts counts = tracker_.update(state_.world_from_body, time, {true, true, true, false}, end);
    const Clock::time_point tracked = Clock::now();
    rows_.update(tracker_.pairs(), state_, time);
    sample[kRows] = static_cast<float>(microsecondsSince(tracked));
    sample[kCycle] = static_cast<float>(microsecondsSince(start));
    const Counters after;
    sample[kProcessor] = static_cast<float>(after.processor - before.processor);
    sample[kAllocations] = static_cast<float>(after.allocated - before.allocated);
    sample[kFaults] = static_cast<float>(after.usage.ru_minflt + after.usage.ru_majflt -
                                         before.usage.ru_minflt - before.usage.ru_majflt);
    sample[kPreempted] = static_cast<float>(after.usage.ru_nivcsw - before.usage.ru_nivcsw);
    sample[kWaits] = static_cast<float>(after.usage.ru_nvcsw - before.usage.ru_nvcsw);
    sample[kPutOff] = static_cast<float>(counts.put_off);
    total_.add(counts);
    for (const auto& pair : tracker_.pairs()) niches_ += pair->solved() ? pair->solution.niches.size() : 0;
    for (const ConstraintRow& row : rows_.rows()) used_rows_ += row.state == SlotState::Used ? 1 : 0;
  }

  std::vector<double> valuesOf(int quantity) const {
    std::vector<double> values;
    values.reserve(samples_.size());
    for (const Sample& sample : samples_) values.push_back(sample[static_cast<std::size_t>(quantity)]);
    return values;
  }

  void printHistogram() const {
    constexpr std::array<double, 14> kBounds{0,   25,  50,  75,  100,  150,  200,
                                             300, 400, 600, 800, 1000, 2000, 5000};
    std::printf("cycles by time, us:%11s %11s %11s %11s\n", "late by", "cycle", "processor", "rows");
    for (std::size_t bin = 0; bin < kBounds.size(); ++bin) {
      const double first = kBounds[bin];
      const double end = bin + 1 < kBounds.size() ? kBounds[bin + 1] : HUGE_VAL;
      std::printf("  from %-12.0f", first);
      for (int quantity = 0; quantity < kTimes; ++quantity) {
        const auto count = std::count_if(samples_.begin(), samples_.end(), [&](const Sample& sample) {
          const double value = sample[static_cast<std::size_t>(quantity)];
          return value >= first && value < end;
        });
        std::printf(" %11td", count);
      }
      std::printf("\n");
    }
  }

  void printLongest() const {
    constexpr std::size_t kMost = 10;
    std::vector<std::size_t> order(samples_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const std::size_t count = std::min(kMost, order.size());
    std::partial_sort(
        order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
        [&](std::size_t l, std::size_t r) { return samples_[l][kProcessor] > samples_[r][kProcessor]; });
    for (std::size_t i = 0; i < count; ++i) {
      const Sample& sample = samples_[order[i]];
      std::printf(
          "  cycle %zu: processor %.0f us of %.0f us, %.0f allocations, %.0f page faults, %.0f lists put "
          "off\n",
          order[i], sample[kProcessor], sample[kCycle], sample[kAllocations], sample[kFaults],
          sample[kPutOff]);
    }
  }

  const MovingScene& moving_;
  const Settings& settings_;
  std::shared_ptr<const SceneKinematics> joints_;
  Eigen::VectorXd positions_;
  SceneState state_;
  SceneTracker tracker_;
  ConstraintRows rows_;
  std::vector<Sample> samples_;
  CycleCounts total_;
  std::size_t niches_ = 0;  ///< of all cycles, as the next
  std::size_t used_rows_ = 0;
  std::size_t left_out_ = 0;
};

void printLoad() {
  std::array<double, 3> load{};
  if (getloadavg(load.data(), 3) == 3)
    std::printf("load of the machine %.2f, %.2f, %.2f\n", load[0], load[1], load[2]);
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  CLI::App app("A control loop: times and disturbances of its cycles");
  std::vector<std::string> scenes{"cell"};
  std::string output;
  Settings settings;
  app.add_option("scenes", scenes);
  app.add_option("--seconds", settings.seconds);
  app.add_option("--rate", settings.rate);
  app.add_option("--threads", settings.threads);
  app.add_option("--share", settings.share);
  app.add_option("--distance", settings.rows.distance);
  app.add_option("--slots", settings.rows.capacity);
  app.add_option("--priority", settings.priority);
  app.add_option("--core", settings.core);
  app.add_flag("--unprepared", settings.is_unprepared);
  app.add_option("--output", output);
  CLI11_PARSE(app, argc, argv);
  ResultTable table(
      output, "scene,threads,priority,cycles,quantity,median,p99,p99_9,p99_99,largest,cycles_above,sum");
  for (const std::string& scene : scenes) {
    const MovingScene moving = movingScene(scene);
    ControlLoop loop(moving, settings);
    printLoad();
    loop.prepare();
    setUpThread(settings);
    loop.run();
    loop.report(table);
    printLoad();
  }
  return 0;
}

}  // namespace concave_distance::benchmark
