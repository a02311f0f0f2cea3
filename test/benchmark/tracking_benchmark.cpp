// Tracked and cold solves at level `certified` beside FCL's plain distance on the same meshes and poses, in
// one run and one thread; every answer is checked against FCL's.
//
//   tracking_benchmark [--pairs name,name,...] [--files a.stl:b.stl,...] [--steps 500,...] [--cutoffs 0,...]
//                      [--output doc/results/tracking.csv]
//
// With `--pairs simple` those whose geometry calls for little; with --files pairs of mesh files, the second
// circling the first one as near as it can without touching it. A row is a pair, a number of instants along
// its motion (5 s long: 500 is 100 Hz) and a cutoff for niches, as a share of the smaller body's diameter (0:
// none): triangles of A and B; milliseconds that making what niches need of both bodies takes, and the first
// cycle with niches of a new tracker after it; medians in microseconds of FCL, of a cold solve of one pose,
// of the first cycle of a prepared tracker, of a warm cycle with all niches (and its 99th percentile), of one
// with the distance alone; warm / FCL (below 1: all niches in less time than FCL's one distance) and FCL /
// distance alone; mean niches; instants; answers that are off FCL's or not proven (wrong, 0 expected) and
// instants that list fewer than 64 niches of which not all are proven to be found (incomplete, 0 expected);
// of the instants that a cold solve saw, too, those at which it lists other niches (other, 0 expected).
#include <algorithm>
#include <cmath>

#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/benchmark_pairs.h"
#include "benchmark/support/circling_pair.h"
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
  int other = 0;
};

TrackerParameters certified(bool niches_wanted) {
  TrackerParameters parameters;
  parameters.accuracy = AccuracyLevel::Certified;
  parameters.niches_wanted = niches_wanted;
  return parameters;
}

/// @param share of the smaller body's diameter; 0: no cutoff
TrackerParameters certifiedWithin(const BenchmarkPair& pair, double share) {
  TrackerParameters parameters = certified(true);
  if (share > 0.0) parameters.cutoff = share * std::min(pair.a->diameter(), pair.b->diameter());
  return parameters;
}

std::vector<double> nicheDistances(const PairSolution& solution) {
  std::vector<double> distances;
  for (const TrackedNiche& niche : solution.niches) distances.push_back(niche.distance);
  return distances;
}

bool areEqual(const std::vector<double>& l, const std::vector<double>& r, double tolerance) {
  return std::equal(l.begin(), l.end(), r.begin(), r.end(),
                    [&](double a, double b) { return std::abs(a - b) <= tolerance; });
}

void prepare(const BenchmarkPair& pair, const TrackerParameters& parameters, Row& row) {
  row.prepare_ms = millisecondsOf([&] { PreparationTask(pair.a, pair.b, parameters).run(); });
  PairTracker tracker(pair.name, pair.a, pair.b, parameters);
  PairSolution solution;
  row.first_list_ms = millisecondsOf([&] { tracker.update(pair.motion(0.0), 0.0, solution); });
}

Row run(const BenchmarkPair& pair, int steps, double cutoff) {
  Row row;
  const TrackerParameters parameters = certifiedWithin(pair, cutoff);
  prepare(pair, parameters, row);
  PairTracker tracker(pair.name, pair.a, pair.b, parameters);
  PairTracker fresh(pair.name, pair.a, pair.b, parameters);
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
    const std::vector<double> tracked = nicheDistances(solution);
    take(row.cold_us, [&] { fresh.solve(pose, solution); });
    check();
    row.other += areEqual(tracked, nicheDistances(solution), 1e-9 * size) ? 0 : 1;
    take(row.first_us, [&] { fresh.update(pose, 0.0, solution); });
    check();
    fresh.restart();
  }
  return row;
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  ProgramOptions options("Tracked and cold solves beside FCL, one run, one thread");
  std::vector<std::string> names = allPairs();
  std::vector<std::string> files;
  std::vector<int> steps{500};
  std::vector<double> cutoffs{0.0};
  options.add("--pairs", names, "Pairs to run, or `simple`; all when left out");
  options.add("--files", files, "Pairs of mesh files instead, a colon between two");
  options.add("--steps", steps, "Instants along each motion", 2);
  options.add("--cutoffs", cutoffs, "Shares of the smaller body's diameter; 0: none", 0.0);
  if (!options.read(argc, argv)) return options.status();
  if (names == std::vector<std::string>{"simple"}) names = simplePairs();

  if (!files.empty()) names = files;

  ResultTable table(options.output(),
                    "pair,steps,cutoff,triangles_a,triangles_b,prepare_ms,first_list_ms,fcl_us,cold_us,"
                    "first_us,warm_us,warm_p99_us,warm_over_fcl,alone_us,alone_p99_us,fcl_over_alone,niches,"
                    "instants,wrong,incomplete,other");
  for (const std::string& name : names) {
    const BenchmarkPair pair = files.empty() ? loadBenchmarkPair(name) : makeCirclingPair(name);
    for (const int count : steps) {
      for (const double cutoff : cutoffs) {
        const Row row = run(pair, count, cutoff);
        const double fcl = median(row.fcl_us);
        const double warm = median(row.warm_us);
        const double alone = median(row.alone_us);
        table.add(pair.name, count, cutoff, pair.a->surface().triangleCount(),
                  pair.b->surface().triangleCount(), row.prepare_ms, row.first_list_ms, fcl,
                  median(row.cold_us), median(row.first_us), warm, percentile(row.warm_us, 0.99), warm / fcl,
                  alone, percentile(row.alone_us, 0.99), fcl / alone, mean(row.niches), count, row.wrong,
                  row.incomplete, row.other);
      }
    }
  }
  return 0;
}

}  // namespace concave_distance::benchmark
