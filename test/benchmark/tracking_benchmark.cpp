// Tracked and cold `refined` solves and tracked `certified` ones beside FCL's plain distance on the same
// meshes and poses, in one run and one thread; every answer is checked against FCL's.
//
//   tracking_benchmark [--pairs name,name,...] [--steps 500] [--output doc/results/tracking.csv]
//
// A row is a pair: triangles and grid nodes of A and B; median time of FCL, of a cold solve, of a warm cycle
// with all niches (and its 99th percentile), all in microseconds; warm / FCL (below 1: all niches in less
// time than FCL's one distance); the same of a warm cycle at `certified`, with all niches and without any;
// mean niches; evaluations a warm cycle; instants where the distance is more than 1e-6 (relative) above FCL's
// (misses) and where it is below by more than 1e-9 of the bodies' size, at `refined`; instants where either
// certified answer is off FCL's or not proven (wrong, 0 expected), and where the proof found what the search
// had missed (found); memory of both bodies and of the tracker, kilobytes.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <fstream>

#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/benchmark_pairs.h"
#include "benchmark/support/statistics.h"
#include "benchmark/support/stopwatch.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "mesh/grid/node_graph.h"

namespace concave_distance::benchmark {
namespace {

struct Row {
  std::vector<double> fcl_us;
  std::vector<double> cold_us;
  std::vector<double> warm_us;
  std::vector<double> certified_us;
  std::vector<double> proof_us;
  std::vector<double> niches;
  std::vector<double> evaluations;
  int wrong = 0;
  int found = 0;
  int cold_misses = 0;
  int misses = 0;
  int below = 0;
  double worst_excess = 0.0;
  std::size_t tracker_bytes = 0;
};

TrackerParameters certified(bool niches_wanted) {
  TrackerParameters parameters;
  parameters.accuracy = AccuracyLevel::Certified;
  parameters.niches_wanted = niches_wanted;
  return parameters;
}

bool isProven(const PairSolution& solution, double exact, double size) {
  return solution.status == SolveStatus::Ok && std::abs(solution.distance - exact) <= 1e-9 * size &&
         solution.lower_bound <= exact + 1e-9 * size;
}

Row run(const BenchmarkPair& pair, int steps, bool list_misses) {
  Row row;
  PairTracker tracker(pair.name, pair.a, pair.b, TrackerParameters());
  PairTracker prover(pair.name, pair.a, pair.b, certified(true));
  PairTracker bare_prover(pair.name, pair.a, pair.b, certified(false));
  PairSolution solution;
  PairSolution cold;
  PairSolution proven;
  PairSolution bare;
  const double size = std::max(pair.a->diameter(), pair.b->diameter());
  for (int k = 0; k < steps; ++k) {
    const double t = steps > 1 ? static_cast<double>(k) / (steps - 1) : 0.0;
    const Eigen::Isometry3d pose = pair.motion(t);
    auto start = std::chrono::steady_clock::now();
    const FclAnswer exact = fclDistance(*pair.fcl_a, *pair.fcl_b, pose);
    row.fcl_us.push_back(microsecondsSince(start));
    start = std::chrono::steady_clock::now();
    tracker.update(pose, 5.0 * t, solution);
    const double taken = microsecondsSince(start);
    start = std::chrono::steady_clock::now();
    prover.update(pose, 5.0 * t, proven);
    const double certified_taken = microsecondsSince(start);
    start = std::chrono::steady_clock::now();
    bare_prover.update(pose, 5.0 * t, bare);
    const double proof_taken = microsecondsSince(start);
    row.wrong += isProven(proven, exact.distance, size) && isProven(bare, exact.distance, size) ? 0 : 1;
    if (k > 0) {
      row.found += proven.search_miss ? 1 : 0;
      row.certified_us.push_back(certified_taken);
      row.proof_us.push_back(proof_taken);
      row.warm_us.push_back(taken);
      row.evaluations.push_back(static_cast<double>(solution.cost.evaluations));
    }
    row.niches.push_back(static_cast<double>(solution.niches.size()));
    const double excess = solution.distance - exact.distance;
    if (!(excess <= 1e-6 * exact.distance)) {
      ++row.misses;
      row.worst_excess = std::max(row.worst_excess, excess / exact.distance);
      if (list_misses) {
        std::printf("  miss: %s step %d fcl %.9g tracked %.9g\n", pair.name.c_str(), k, exact.distance,
                    solution.distance);
      }
    }
    row.below += excess < -1e-9 * size ? 1 : 0;
    if (k % 25 == 0) {
      start = std::chrono::steady_clock::now();
      PairTracker fresh(pair.name, pair.a, pair.b, TrackerParameters());
      fresh.update(pose, 0.0, cold);
      row.cold_us.push_back(microsecondsSince(start));
      row.cold_misses += cold.distance <= (1.0 + 1e-6) * exact.distance ? 0 : 1;
    }
  }
  row.tracker_bytes = tracker.memoryBytes();
  return row;
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  CLI::App app("Tracked and cold solves beside FCL, one run, one thread");
  std::vector<std::string> names = allPairs();
  int steps = 500;
  bool list_misses = false;
  std::string output;
  app.add_option("--pairs", names, "Pairs to run; all when left out")->delimiter(',');
  app.add_option("--steps", steps, "Instants along each motion")->check(CLI::PositiveNumber);
  app.add_flag("--list-misses", list_misses, "Print every instant whose distance is above FCL's");
  app.add_option("--output", output, "CSV file to write");
  CLI11_PARSE(app, argc, argv);

  std::ofstream csv;
  if (!output.empty()) {
    csv.open(output);
    csv << "pair,triangles_a,triangles_b,nodes_a,nodes_b,fcl_us,cold_us,warm_us,warm_p99_us,warm_over_fcl,"
           "niches,"
           "evaluations,misses,instants,below,worst_relative_excess,cold_misses,cold_solves,bodies_kb,"
           "tracker_kb,certified_us,certified_p99_us,fcl_over_certified,proof_us,proof_p99_us,fcl_over_proof,"
           "certified_wrong,found_by_proof\n";
  }
  std::printf(
      "%-20s %6s %6s %6s %6s %8s %9s %8s %8s %6s %8s %8s %6s %8s %8s %6s %6s %6s %9s %5s %9s %5s %5s %5s "
      "%8s\n",
      "pair", "tri A", "tri B", "node A", "node B", "FCL us", "cold us", "warm us", "p99 us", "w/FCL",
      "cert us", "p99 us", "FCL/c", "proof us", "p99 us", "FCL/p", "niches", "evals", "misses", "below",
      "excess", "cold!", "wrong", "found", "kB");
  for (const std::string& name : names) {
    const BenchmarkPair pair = loadBenchmarkPair(name);
    const Row row = run(pair, steps, list_misses);
    const double fcl = median(row.fcl_us);
    const double warm = median(row.warm_us);
    const double certified_us = median(row.certified_us);
    const double proof = median(row.proof_us);
    const std::size_t body_kb = (pair.a->memoryBytes() + pair.b->memoryBytes()) / 1024;
    std::printf(
        "%-20s %6zu %6zu %6zu %6zu %8.1f %9.1f %8.1f %8.1f %6.3f %8.1f %8.1f %6.1f %8.2f %8.2f %6.1f %6.1f "
        "%6.0f %4d/%4d %5d %9.2e %2d/%2zu %5d %5d %8zu\n",
        name.c_str(), pair.a->surface().triangleCount(), pair.b->surface().triangleCount(),
        pair.a->graph().nodeCount(), pair.b->graph().nodeCount(), fcl, median(row.cold_us), warm,
        percentile(row.warm_us, 0.99), warm / fcl, certified_us, percentile(row.certified_us, 0.99),
        fcl / certified_us, proof, percentile(row.proof_us, 0.99), fcl / proof, mean(row.niches),
        mean(row.evaluations), row.misses, steps, row.below, row.worst_excess, row.cold_misses,
        row.cold_us.size(), row.wrong, row.found, body_kb);
    std::fflush(stdout);
    if (csv) {
      csv << name << ',' << pair.a->surface().triangleCount() << ',' << pair.b->surface().triangleCount()
          << ',' << pair.a->graph().nodeCount() << ',' << pair.b->graph().nodeCount() << ',' << fcl << ','
          << median(row.cold_us) << ',' << warm << ',' << percentile(row.warm_us, 0.99) << ',' << warm / fcl
          << ',' << mean(row.niches) << ',' << mean(row.evaluations) << ',' << row.misses << ',' << steps
          << ',' << row.below << ',' << row.worst_excess << ',' << row.cold_misses << ','
          << row.cold_us.size() << ',' << body_kb << ',' << row.tracker_bytes / 1024 << ',' << certified_us
          << ',' << percentile(row.certified_us, 0.99) << ',' << fcl / certified_us << ',' << proof << ','
          << percentile(row.proof_us, 0.99) << ',' << fcl / proof << ',' << row.wrong << ',' << row.found
          << '\n';
    }
  }
  return 0;
}

}  // namespace concave_distance::benchmark
