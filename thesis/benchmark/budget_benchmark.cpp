// Measures what a time budget leaves of the list of niches, and what the search is worth then, by tracked
// cycles that end early beside a tracker that takes its time.
//
//   budget_benchmark [--pairs name,name,...] [--budgets 50,100,200,500] [--shares 0,0.05,0.1,0.3] [--steps
//   500]
//                    [--proposers evolution,random,near] [--cold] [--output FILE]
//
// A row is a pair, a budget (microseconds), what proposes niches and its share of the work
// (TrackerParameters:: search_share; at 0 the rest is one row, `none`): `recall`, the share of the visible
// niches at an instant that are reported with their place; `precision`, the share of the reported ones that
// are such; `complete`, the share of cycles that ended with the whole list; mean microseconds of a cycle, and
// mean niches of a cycle that the search was the first to have (`evolved`). Proposers: `evolution`, the
// shipped search; `random`, as many descents from random node pairs; `near`, from node pairs around the known
// niches. Pairs are in halves by their place in the list: what is chosen on the one is confirmed on the other
// (`half`).
//
// With --cold, every instant is the first cycle of a tracker.
#include <CLI/CLI.hpp>

#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/benchmark_pairs.h"
#include "benchmark/support/result_table.h"
#include "benchmark/support/statistics.h"
#include "benchmark/support/stopwatch.h"
#include "concave_distance/tracking/pair_tracker.h"

namespace concave_distance::benchmark {
namespace {

struct Niche {
  double distance;
  Eigen::Vector3d point_a;
  Eigen::Vector3d point_b;
  NicheKind kind;
};
using Niches = std::vector<Niche>;

Niches nichesOf(const PairSolution& solution) {
  Niches niches;
  for (const TrackedNiche& niche : solution.niches) {
    niches.push_back({niche.distance, niche.point_a_in_a, niche.point_b_in_a, niche.kind});
  }
  return niches;
}

/// Sets are the same where their distances are and their middles are near.
std::size_t countOf(const Niches& niches, const Niches& others, double size) {
  return static_cast<std::size_t>(std::count_if(niches.begin(), niches.end(), [&](const Niche& niche) {
    const double near = niche.kind == NicheKind::Point ? 1e-6 * size : 1e-2 * size;
    return std::any_of(others.begin(), others.end(), [&](const Niche& other) {
      return std::abs(niche.distance - other.distance) <= 1e-8 * size &&
             (niche.point_a - other.point_a).norm() <= near && (niche.point_b - other.point_b).norm() <= near;
    });
  }));
}

struct Motion {
  std::vector<Eigen::Isometry3d> poses;
  std::vector<Niches> niches;
};

Motion follow(const BenchmarkPair& pair, int steps) {
  Motion motion;
  TrackerParameters parameters;
  parameters.search_share = 0.0;
  PairTracker tracker(pair.name, pair.a, pair.b, parameters);
  PairSolution solution;
  for (int k = 0; k < steps; ++k) {
    motion.poses.push_back(pair.motion(static_cast<double>(k) / steps));
    tracker.update(motion.poses.back(), 5.0 * k / steps, solution);
    motion.niches.push_back(nichesOf(solution));
  }
  return motion;
}

void setProposer(const std::string& name, TrackerParameters& parameters) {
  if (name == "evolution") return;
  for (GeneticParameters* genetic : {&parameters.cold, &parameters.warm}) {
    genetic->crossover_probability = 0.0;
    genetic->exchange_probability = 0.0;
    genetic->mutation_probability = name == "near" ? 1.0 : 0.0;
    genetic->random_immigrants = name == "near" ? 0 : genetic->population_size;
  }
  if (name == "near") parameters.random_starts = 0;
  if (name == "random") parameters.inherited_limit = 0;
}

struct Result {
  std::vector<double> recall;
  std::vector<double> precision;
  std::vector<double> complete;
  std::vector<double> cycle_us;
  std::vector<double> evolved;
};

Result observe(const BenchmarkPair& pair, const Motion& motion, const TrackerParameters& parameters,
               bool is_cold) {
  Result result;
  const double size = pair.a->diameter() + pair.b->diameter();
  PairTracker tracker(pair.name, pair.a, pair.b, parameters);
  tracker.prepare();
  PairSolution solution;
  for (std::size_t k = 0; k < motion.poses.size(); ++k) {
    if (is_cold) tracker.reset();
    const auto start = std::chrono::steady_clock::now();
    tracker.update(motion.poses[k], 0.01 * static_cast<double>(k), solution);
    const double taken = microsecondsSince(start);
    if (k == 0 && !is_cold) continue;
    const Niches found = nichesOf(solution);
    const Niches& wanted = motion.niches[k];
    if (!wanted.empty()) {
      result.recall.push_back(static_cast<double>(countOf(wanted, found, size)) /
                              static_cast<double>(wanted.size()));
    }
    if (!found.empty()) {
      result.precision.push_back(static_cast<double>(countOf(found, wanted, size)) /
                                 static_cast<double>(found.size()));
    }
    result.complete.push_back(solution.niches_complete || solution.niches_cut ? 1.0 : 0.0);
    result.cycle_us.push_back(taken);
    result.evolved.push_back(static_cast<double>(
        std::count_if(solution.niches.begin(), solution.niches.end(),
                      [](const TrackedNiche& niche) { return niche.origin == NicheOrigin::Evolved; })));
  }
  return result;
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  std::vector<std::string> names = allPairs();
  std::vector<double> budgets{50.0, 100.0, 200.0, 500.0};
  std::vector<double> shares{0.0, 0.05, 0.1, 0.3};
  std::vector<std::string> proposers{"evolution", "random", "near"};
  int steps = 500;
  bool is_cold = false;
  std::string output;
  CLI::App app("Cycles that end early");
  app.add_option("--pairs", names, "names")->delimiter(',');
  app.add_option("--budgets", budgets, "microseconds")->delimiter(',');
  app.add_option("--shares", shares, "of the search")->delimiter(',');
  app.add_option("--proposers", proposers, "evolution, random, near")->delimiter(',');
  app.add_option("--steps", steps, "instants along the motion");
  app.add_flag("--cold", is_cold, "every instant is a first cycle");
  app.add_option("--output", output, "CSV file");
  CLI11_PARSE(app, argc, argv);
  ResultTable table(output, "pair,half,budget_us,proposer,share,recall,precision,complete,cycle_us,evolved");
  for (std::size_t i = 0; i < names.size(); ++i) {
    const BenchmarkPair pair = loadBenchmarkPair(names[i]);
    const Motion motion = follow(pair, steps);
    for (const double budget : budgets) {
      for (const std::string& proposer : proposers) {
        for (const double share : shares) {
          if (share == 0.0 && proposer != proposers.front()) continue;
          TrackerParameters parameters;
          setProposer(proposer, parameters);
          parameters.search_share = share;
          parameters.time_budget = budget * 1e-6;
          const Result result = observe(pair, motion, parameters, is_cold);
          table.add(names[i], i % 2 == 0 ? "a" : "b", budget, share == 0.0 ? "none" : proposer, share,
                    mean(result.recall), mean(result.precision), mean(result.complete), mean(result.cycle_us),
                    mean(result.evolved));
        }
      }
    }
  }
  return 0;
}

}  // namespace concave_distance::benchmark
