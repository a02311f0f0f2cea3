// What idle cores save in a cycle of one pair: the front of normal cones with one thread and with several.
//
//   cores_benchmark [--pairs name,name,...] [--steps 500,5000] [--instants 50] [--windows 8] [--threads 2]
//                   [--pause 2] [--pinned] [--sliced-from 8192] [--output FILE]
//
// Beside the pairs that have a name, `scan` is a hook above a sheet of 70,000 triangles, rough as a depth
// camera sees a table. In windows spread over a motion (5 s long: 500 steps are 100 Hz) consecutive instants
// are looked at, the first one cold. Before a cycle the program sleeps for `pause` milliseconds, as a node
// does: threads that are needed have to wake up.
//
// A row is a pair, a number of instants along its motion, and those of the cycles (cold or warm) that
// compared fewer than `below` groups, at least half as many: their number, slices (mean), microseconds
// (medians and 95th percentiles) with one thread and with `threads`, the ratio of the medians, and cycles
// whose minima differed (`other`: none may).
#include <pthread.h>
#include <tbb/task_arena.h>
#include <tbb/task_scheduler_observer.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <map>
#include <thread>

#include "base/helping_threads.h"
#include "base/random_engine.h"
#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/benchmark_pairs.h"
#include "benchmark/support/shapes.h"
#include "benchmark/support/statistics.h"
#include "benchmark/support/stopwatch.h"
#include "distance/kernels/pair_frame.h"
#include "distance/minima/minima_tracker.h"

namespace concave_distance::benchmark {
namespace {

using detail::MinimaTracker;
using Eigen::Vector3d;

/// A sheet over the unit square: bumps of 5 cm, and 1 mm of noise.
SurfaceMesh makeScan(int cells) {
  RandomEngine engine(1);
  std::vector<Vector3d> vertices;
  std::vector<TriangleNodes> triangles;
  const auto node = [cells](int row, int column) {
    return NodeIndex{static_cast<std::uint32_t>(row * (cells + 1) + column)};
  };
  for (int row = 0; row <= cells; ++row) {
    for (int column = 0; column <= cells; ++column) {
      const double x = static_cast<double>(row) / cells;
      const double y = static_cast<double>(column) / cells;
      vertices.emplace_back(
          x, y, 0.05 * std::sin(15.0 * x) * std::cos(11.0 * y) + 1e-3 * (uniformUnit(engine) - 0.5));
    }
  }
  for (int row = 0; row < cells; ++row) {
    for (int column = 0; column < cells; ++column) {
      triangles.push_back({node(row, column), node(row + 1, column), node(row + 1, column + 1)});
      triangles.push_back({node(row, column), node(row + 1, column + 1), node(row, column + 1)});
    }
  }
  return SurfaceMesh(std::move(vertices), std::move(triangles), "scan");
}

BenchmarkPair loadPair(const std::string& name) {
  if (name != "scan") return loadBenchmarkPair(name);
  BenchmarkPair pair;
  pair.name = name;
  pair.a = std::make_shared<BodyMesh>("scan", makeScan(187), BodyMeshOptions());
  pair.b = std::make_shared<BodyMesh>("hook", makeHook(0.15, 0.03, 0.3, 96, 24), BodyMeshOptions());
  pair.motion = [](double t) {
    Eigen::Isometry3d pose(Eigen::AngleAxisd(1.2 + 2.0 * t, Vector3d(0.8, 0.5, 0.3).normalized()));
    pose.translation() = Vector3d(0.3 + 0.4 * t, 0.4 + 0.2 * t, 0.35);
    return pose;
  };
  return pair;
}

struct Class {
  std::vector<double> one_us;
  std::vector<double> many_us;
  std::uint64_t slices = 0;
  int other = 0;
};
using Classes = std::map<std::pair<bool, std::uint32_t>, Class>;  ///< warm or not, `below`

bool isSame(const std::vector<MinimumCandidate>& l, const std::vector<MinimumCandidate>& r) {
  return std::equal(l.begin(), l.end(), r.begin(), r.end(),
                    [](const MinimumCandidate& x, const MinimumCandidate& y) {
                      return x.a == y.a && x.b == y.b && x.distance == y.distance && x.point_a == y.point_a &&
                             x.point_b == y.point_b;
                    });
}

/// Every thread of an arena on a core of its own: some schedulers put a thread that wakes up on the core of
/// the one that woke it, even while other cores are idle.
class OnOwnCores : public tbb::task_scheduler_observer {
 public:
  explicit OnOwnCores(tbb::task_arena& arena) : tbb::task_scheduler_observer(arena) { observe(true); }
  ~OnOwnCores() override { observe(false); }
  void on_scheduler_entry(bool /*is_worker*/) override {
    cpu_set_t core;
    CPU_ZERO(&core);
    CPU_SET(static_cast<std::size_t>(tbb::this_task_arena::current_thread_index()), &core);
    pthread_setaffinity_np(pthread_self(), sizeof core, &core);
  }
};

/// The same cycles in two arenas.
class Comparison {
 public:
  Comparison(int threads, int pause, bool pinned, std::size_t sliced_from)
      : one_(1), many_(threads), pause_(pause), front_of_one_(sliced_from), front_of_many_(sliced_from) {
    one_.initialize();
    many_.initialize();
    if (pinned) on_own_cores_ = std::make_unique<OnOwnCores>(many_);
  }

  void begin() {
    front_of_one_.clear();
    front_of_many_.clear();
  }

  void observe(const BenchmarkPair& pair, double t, bool many_first, Classes& classes) {
    const detail::PairFrame scene = detail::PairFrame::withFacets(*pair.a, *pair.b, pair.motion(t));
    double one_us = 0.0;
    double many_us = 0.0;
    if (many_first) many_us = collect(many_, scene, front_of_many_, of_many_);
    one_us = collect(one_, scene, front_of_one_, of_one_);
    if (!many_first) many_us = collect(many_, scene, front_of_many_, of_many_);
    const MinimaTracker::Counts& counts = front_of_one_.counts();
    std::uint32_t below = 128;
    while (below <= counts.groups) below *= 2;
    Class& of = classes[{!counts.began_anew, below}];
    of.one_us.push_back(one_us);
    of.many_us.push_back(many_us);
    of.slices += counts.slices;
    of.other += isSame(of_one_, of_many_) ? 0 : 1;
  }

 private:
  double collect(tbb::task_arena& arena, const detail::PairFrame& scene, MinimaTracker& front,
                 std::vector<MinimumCandidate>& seeds) {
    std::this_thread::sleep_for(std::chrono::milliseconds(pause_));
    double us = 0.0;
    HelpingThreads helpers;
    helpers.begin();
    arena.execute([&] {
      WorkLimit none;
      seeds.clear();
      const auto start = std::chrono::steady_clock::now();
      helpers.share([&] {
        front.collect(scene, NormalSides::Outside, std::numeric_limits<double>::infinity(), seeds, none);
      });
      us = microsecondsSince(start);
    });
    return us;
  }

  tbb::task_arena one_;
  tbb::task_arena many_;
  std::unique_ptr<OnOwnCores> on_own_cores_;
  int pause_;
  MinimaTracker front_of_one_;
  MinimaTracker front_of_many_;
  std::vector<MinimumCandidate> of_one_;
  std::vector<MinimumCandidate> of_many_;
};

void print(const std::string& name, int steps, const Classes& classes, std::ofstream& file) {
  for (const auto& [key, of] : classes) {
    const double one_us = median(of.one_us);
    const double many_us = median(of.many_us);
    char line[256];
    std::snprintf(line, sizeof line, "%s,%d,%s,%u,%zu,%.1f,%.1f,%.1f,%.3f,%.1f,%.1f,%d", name.c_str(), steps,
                  key.first ? "warm" : "cold", key.second, of.one_us.size(),
                  static_cast<double>(of.slices) / static_cast<double>(of.one_us.size()), one_us, many_us,
                  many_us / one_us, percentile(of.one_us, 0.95), percentile(of.many_us, 0.95), of.other);
    std::printf("%s\n", line);
    std::fflush(stdout);
    if (file) file << line << '\n';
  }
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  std::vector<std::string> names = robotPairs();
  names.emplace_back("scan");
  std::vector<int> steps{500, 5000};
  int instants = 50;
  int windows = 8;
  int threads = 2;
  int pause = 2;
  bool pinned = false;
  std::size_t sliced_from = detail::ConeSlices::kManyExpired;
  std::string output;
  CLI::App app("The front of normal cones with idle cores");
  app.add_option("--pairs", names, "names")->delimiter(',');
  app.add_option("--steps", steps, "instants along the motion")->delimiter(',');
  app.add_option("--instants", instants, "consecutive instants of a window");
  app.add_option("--windows", windows, "windows along the motion");
  app.add_option("--threads", threads, "of the second arena");
  app.add_option("--pause", pause, "milliseconds before a cycle");
  app.add_flag("--pinned", pinned, "every thread on a core of its own");
  app.add_option("--sliced-from", sliced_from, "expired pairs from which on a warm cycle is sliced");
  app.add_option("--output", output, "CSV file");
  CLI11_PARSE(app, argc, argv);
  std::ofstream file;
  if (!output.empty()) file.open(output);
  const char* header =
      "pair,steps,start,below,cycles,slices,one_us,many_us,many_over_one,one_95_us,many_95_us,other";
  std::printf("%s\n", header);
  if (file) file << header << '\n';
  for (const std::string& name : names) {
    const BenchmarkPair pair = loadPair(name);
    for (const int count : steps) {
      Classes classes;
      Comparison comparison(threads, pause, pinned, sliced_from);
      for (int window = 0; window < windows; ++window) {
        comparison.begin();
        const int begin = (count - instants) * (2 * window + 1) / (2 * windows);
        for (int i = 0; i < instants; ++i) {
          comparison.observe(pair, static_cast<double>(begin + i) / count, i % 2 == 0, classes);
        }
      }
      print(name, count, classes, file);
    }
  }
  return 0;
}

}  // namespace concave_distance::benchmark
