// Tracked and cold solves at level `certified` beside FCL's plain distance on the same meshes and poses, in
// one run and one thread; every answer is checked against FCL's.
//
//   tracking_benchmark [--pairs name,name,...] [--steps 500] [--output doc/results/tracking.csv]
//
// With `--pairs simple` those whose geometry calls for little. A row is a pair: triangles of A and B;
// milliseconds that making what niches need of both bodies takes, and the first cycle with niches of a new
// tracker after it; medians in microseconds of FCL, of a cold solve of one pose, of the first cycle of a
// prepared tracker, of a warm cycle with all niches (and its 99th percentile), of one with
// the distance alone; warm / FCL (below 1: all niches in less time than FCL's one distance) and FCL /
// distance alone; mean niches; instants; answers that are off FCL's or not proven (wrong, 0 expected) and
// instants that list fewer than 64 niches of which not all are proven to be found (incomplete, 0 expected);
// memory of both bodies and of the tracker, kilobytes.

#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/benchmark_pairs.h"
#include "benchmark/support/program_options.h"
#include "benchmark/support/result_table.h"
#include "benchmark/support/statistics.h"
#include "benchmark/support/stopwatch.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "scene/niche_preparation.h"

namespace concave_distance::benchmark {
namespace {

constexpr int kStepsBetweenColdSolves = 25;

struct Row {
  double prepare_ms = 0.0;
  double first_list_ms = 0.0;
  std::vector<double> fcl_us;
  std::vector<double> cold_us;
  std::vector<double> first_us;
  std::vector<double> warm_us;
  std::vector<double> alone_us;
  std::vector<double> niches;
  int wrong = 0;
  int incomplete = 0;
  std::size_t tracker_bytes = 0;
};

TrackerParameters certified(bool niches_wanted) {
  TrackerParameters parameters;
  parameters.accuracy = AccuracyLevel::Certified;
  parameters.niches_wanted = niches_wanted;
  return parameters;
}

void prepare(const BenchmarkPair& pair, Row& row) {
  row.prepare_ms = millisecondsOf([&] { PreparationTask(pair.a, pair.b, certified(true)).run(); });
  PairTracker tracker(pair.name, pair.a, pair.b, certified(true));
  PairSolution solution;
  row.first_list_ms = millisecondsOf([&] { tracker.update(pair.motion(0.0), 0.0, solution); });
}

Row run(const BenchmarkPair& pair, int steps) {
  Row row;
  prepare(pair, row);
  PairTracker tracker(pair.name, pair.a, pair.b, certified(true));
  PairTracker fresh(pair.name, pair.a, pair.b, certified(true));
  PairTracker alone(pair.name, pair.a, pair.b, certified(false));
  fresh.prepare({pair.motion(0.0)});
  PairSolution solution;
  const double size = std::max(pair.a->diameter(), pair.b->diameter());
  double exact = 0.0;
  const auto check = [&] {
    const double distance = std::max(exact, 0.0);
    const SolveStatus expected = exact > 0.0 ? SolveStatus::Ok : SolveStatus::Penetrating;
    row.wrong += solution.status == expected && std::abs(solution.distance - distance) <= 1e-9 * size &&
                         !(solution.lower_bound > distance + 1e-9 * size)
                     ? 0
                     : 1;
  };
  const auto take = [&](std::vector<double>& times, const auto& solve) {
    times.push_back(1e3 * millisecondsOf(solve));
  };
  for (int k = 0; k < steps; ++k) {
    const double t = steps > 1 ? static_cast<double>(k) / (steps - 1) : 0.0;
    const Eigen::Isometry3d pose = pair.motion(t);
    take(row.fcl_us, [&] { exact = fclDistance(*pair.fcl_a, *pair.fcl_b, pose).distance; });
    take(row.alone_us, [&] { alone.update(pose, 5.0 * t, solution); });
    check();
    take(row.warm_us, [&] { tracker.update(pose, 5.0 * t, solution); });
    check();
    row.incomplete += solution.niches_complete || solution.niches_cut ? 0 : 1;
    row.niches.push_back(static_cast<double>(solution.niches.size()));
    if (k == 0) {
      row.warm_us.clear();
      row.alone_us.clear();
    }
    if (k % kStepsBetweenColdSolves != 0) continue;
    take(row.cold_us, [&] { fresh.solve(pose, solution); });
    check();
    take(row.first_us, [&] { fresh.update(pose, 0.0, solution); });
    check();
    fresh.restart();
  }
  row.tracker_bytes = tracker.memoryBytes();
  return row;
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  ProgramOptions options("Tracked and cold solves beside FCL, one run, one thread");
  std::vector<std::string> names = allPairs();
  int steps = 500;
  options.add("--pairs", names, "Pairs to run, or `simple`; all when left out");
  options.add("--steps", steps, "Instants along each motion", 2);
  if (!options.read(argc, argv)) return options.status();
  if (names == std::vector<std::string>{"simple"}) names = simplePairs();

  ResultTable table(
      options.output(),
      "pair,triangles_a,triangles_b,prepare_ms,first_list_ms,fcl_us,cold_us,first_us,warm_us,warm_p99_us,"
      "warm_over_fcl,"
      "alone_us,alone_p99_us,fcl_over_alone,niches,instants,wrong,incomplete,bodies_kb,tracker_kb");
  for (const std::string& name : names) {
    const BenchmarkPair pair = loadBenchmarkPair(name);
    const Row row = run(pair, steps);
    const double fcl = median(row.fcl_us);
    const double warm = median(row.warm_us);
    const double alone = median(row.alone_us);
    table.add(name, pair.a->surface().triangleCount(), pair.b->surface().triangleCount(), row.prepare_ms,
              row.first_list_ms, fcl, median(row.cold_us), median(row.first_us), warm,
              percentile(row.warm_us, 0.99), warm / fcl, alone, percentile(row.alone_us, 0.99), fcl / alone,
              mean(row.niches), steps, row.wrong, row.incomplete,
              (pair.a->memoryBytes() + pair.b->memoryBytes()) / 1024, row.tracker_bytes / 1024);
  }
  return 0;
}

}  // namespace concave_distance::benchmark
