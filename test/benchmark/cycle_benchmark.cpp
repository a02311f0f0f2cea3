// Cycles with an end, as the node runs them, without ROS: how many are late, and how long lists wait.
//
//   cycle_benchmark [robot] [cell] [ROBOT.urdf[,ROBOT.srdf] ...] [--seconds 60] [--rate 50] [--share 0.8]
//   [--threads 1,2] [--pairs] [--output FILE]
//
// The arm of the demo scenes moves along its path; every joint of another robot sways. Poses follow each
// other by a period, but the program does not wait for it: a cycle is late when it takes longer. Every pair
// has all its niches. --share is the cycle's budget as a share of the period; 0: no end. A row is a number of
// threads: pairs that ever were near and, a cycle, pairs within their cutoff; cycles, late ones; milliseconds
// of a cycle: mean, 99th percentile, longest; of the lists of pairs within their cutoff the share that is
// complete; of the cycles the share in which all are; how many cycles a pair was without a complete list at
// most. With --pairs, each pair that ever waited: its cycles, those without a complete list, its longest
// wait.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/moving_scene.h"
#include "benchmark/support/result_table.h"
#include "benchmark/support/statistics.h"
#include "concave_distance/kinematics/scene_kinematics.h"
#include "concave_distance/scene/scene_tracker.h"

namespace concave_distance::benchmark {
namespace {

using Clock = WorkLimit::Clock;
/// Counts how the lists of one pair were over the cycles.
struct Waits {
  std::size_t lists = 0;
  std::size_t incomplete = 0;
  std::size_t now = 0;
  std::size_t longest = 0;

  bool add(const TrackedPair& pair) {
    if (!pair.solved()) {
      now = 0;
      return true;
    }
    const PairSolution& solution = pair.solution;
    const bool is_whole = solution.niches_complete || solution.niches_cut;
    ++lists;
    incomplete += is_whole ? 0 : 1;
    now = is_whole ? 0 : now + 1;
    longest = std::max(longest, now);
    return is_whole;
  }
};

struct Settings {
  double seconds = 60.0;
  double rate = 50.0;
  double share = 0.8;
  bool prints_pairs = false;
};

void measure(const MovingScene& moving, std::uint32_t threads, const Settings& settings, ResultTable& table) {
  SceneTracker tracker({threads, nullptr});
  tracker.setScene(moving.scene);
  const SceneKinematics joints(moving.scene);
  Eigen::VectorXd positions = joints.restPositions();
  SceneState state = joints.startState();
  const double period = 1.0 / settings.rate;
  const auto cycles = static_cast<std::size_t>(std::lround(settings.seconds * settings.rate));
  std::map<std::string, Waits> waits;  // of every pair that ever was near, by name
  std::vector<double> milliseconds;
  std::size_t whole = 0;
  moving.move(0.0, joints, positions);
  joints.evaluate(positions, state);
  tracker.prepare(state.world_from_body, -period);
  for (std::size_t cycle = 0; cycle < cycles; ++cycle) {
    const double time = static_cast<double>(cycle) * period;
    moving.move(time, joints, positions);
    joints.evaluate(positions, state);
    const Clock::time_point start = Clock::now();
    const std::chrono::duration<double> budget(settings.share * period);
    const Clock::time_point end =
        settings.share > 0.0 ? start + std::chrono::duration_cast<Clock::duration>(budget) : kNoCycleEnd;
    tracker.update(state.world_from_body, time, {true, true, true, false}, end);
    const double taken = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    milliseconds.push_back(taken);
    bool are_whole = true;
    for (const auto& pair : tracker.pairs()) {
      if (!waits[pair->origin->name].add(*pair)) are_whole = false;
    }
    whole += are_whole ? 1 : 0;
  }
  std::size_t lists = 0;
  std::size_t incomplete = 0;
  std::size_t longest = 0;
  for (const auto& [name, pair] : waits) {
    lists += pair.lists;
    incomplete += pair.incomplete;
    longest = std::max(longest, pair.longest);
    if (!settings.prints_pairs || pair.incomplete == 0) continue;
    std::printf("%s: %zu of %zu lists incomplete, at most %zu in a row\n", name.c_str(), pair.incomplete,
                pair.lists, pair.longest);
  }
  const auto late = std::count_if(milliseconds.begin(), milliseconds.end(),
                                  [&](double taken) { return taken > 1e3 * period; });
  const auto count = static_cast<double>(cycles);
  table.add(moving.name, threads, waits.size(), static_cast<double>(lists) / count, cycles, late,
            mean(milliseconds), percentile(milliseconds, 0.99), percentile(milliseconds, 1.0),
            1.0 - static_cast<double>(incomplete) / static_cast<double>(std::max<std::size_t>(lists, 1)),
            static_cast<double>(whole) / count, longest);
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  CLI::App app("Cycles with an end: lateness and complete lists");
  std::vector<std::string> scenes{"robot", "cell"};
  std::string output;
  std::vector<std::uint32_t> threads{1, 2};
  Settings settings;
  app.add_option("scenes", scenes);
  app.add_option("--seconds", settings.seconds);
  app.add_option("--rate", settings.rate);
  app.add_option("--share", settings.share);
  app.add_option("--threads", threads)->delimiter(',');
  app.add_flag("--pairs", settings.prints_pairs);
  app.add_option("--output", output);
  CLI11_PARSE(app, argc, argv);
  ResultTable table(output,
                    "scene,threads,pairs,near,cycles,late,mean_ms,p99_ms,longest_ms,lists_complete,"
                    "cycles_complete,longest_wait");
  for (const std::string& scene : scenes) {
    const MovingScene moving = movingScene(scene);
    for (const std::uint32_t count : threads) measure(moving, count, settings, table);
  }
  return 0;
}

}  // namespace concave_distance::benchmark
