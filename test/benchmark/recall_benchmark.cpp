// Recall of the true niches along motions, cycle by cycle, and how late a newborn niche is reported.
//
//   recall_benchmark [--pairs ...] [--steps 200] [--windows 4] [--window 10]
//                    [--output doc/results/recall.csv]
//
// A pair is tracked at every instant; the truth is known in some windows of consecutive instants, spread
// evenly, because it costs a thousand times a cycle. Truth: the visible niches of prominence >= 1e-2 on the
// grid (flood of the product graph, refined), cutoff 5 times the minimum or a quarter of the smaller body's
// diameter, whichever is larger. A niche counts as missed in every cycle until it is reported. Births: true
// niches that appear within a window and are reported in it; latency: cycles from the one to the other;
// unreported: those that vanish or whose window ends first. Cold: a fresh tracker in the middle of each
// window. Beside the recall of all niches stands that of the prominent ones, >= 5e-2 on the grid: around 1e-2
// grid and triangles disagree about which side of the threshold a niche is on, and most niches of an arm's
// links lie there.
#include <tbb/parallel_for.h>
#include <CLI/CLI.hpp>

#include <cmath>
#include <cstdio>
#include <fstream>

#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/reference_niches.h"
#include "benchmark/support/search_trial.h"
#include "benchmark/support/statistics.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "distance/kernels/witness_refinement.h"
#include "distance/niches/niche_properties.h"

namespace concave_distance::benchmark {
namespace {

constexpr double kLeastProminence = 1e-2;
constexpr double kProminent = 5e-2;

// A true niche followed from instant to instant.
struct Followed {
  WitnessPair witness;
  int unreported = 0;  // cycles it has been missing
  bool reported = false;
  bool from_the_start = false;
};

struct Tally {
  double truths = 0.0;
  double recalled = 0.0;
  double prominent_truths = 0.0;
  double prominent_recalled = 0.0;
  double cold_truths = 0.0;
  double cold_recalled = 0.0;
  std::vector<double> latencies;
  int born = 0;  ///< within a window
};

std::vector<WitnessPair> witnesses(const PairSolution& solution) {
  std::vector<WitnessPair> found;
  for (const TrackedNiche& niche : solution.niches) {
    found.push_back(niche.witness);
  }
  return found;
}

// For every reference the entry of `followed` that has moved to it, or null. The true niches of the last
// instant are refined at this one; each reference takes the first of those nearest to it that is the same
// niche.
std::vector<const Followed*> predecessors(const BenchmarkPair& pair, const Eigen::Isometry3d& pose,
                                          const std::vector<Followed>& followed,
                                          const std::vector<ReferenceNiche>& references,
                                          RefinementWorkspace& workspace) {
  std::vector<WitnessPair> moved;
  for (const Followed& before : followed) {
    moved.push_back(
        refineWitness(*pair.a, *pair.b, pose, before.witness.triangle_a, before.witness.triangle_b, workspace)
            .witness);
  }
  std::vector<const Followed*> found;
  for (const std::size_t match : matchReferences(pair, pose, moved, references, kLeastProminence)) {
    found.push_back(match == kNoMatch ? nullptr : &followed[match]);
  }
  return found;
}

// Which instants the truth is known at.
struct Windows {
  int count;
  int length;
  int steps;

  int start(int window) const {
    return std::max(0, static_cast<int>((window + 0.5) * steps / count) - length / 2);
  }
  int end(int window) const { return std::min(steps, start(window) + length); }
};

int observedInstants(const Windows& windows) {
  int observed = 0;
  for (int window = 0; window < windows.count; ++window) {
    observed += windows.end(window) - windows.start(window);
  }
  return observed;
}

std::vector<std::vector<ReferenceNiche>> truthOf(const BenchmarkPair& pair,
                                                 const std::vector<Eigen::Isometry3d>& poses,
                                                 const Windows& windows) {
  std::vector<std::size_t> instants;
  for (int window = 0; window < windows.count; ++window) {
    for (int k = windows.start(window); k < windows.end(window); ++k) {
      instants.push_back(static_cast<std::size_t>(k));
    }
  }
  std::vector<std::vector<ReferenceNiche>> truth(poses.size());
  tbb::parallel_for(std::size_t{0}, instants.size(), [&](std::size_t i) {
    const Eigen::Isometry3d& pose = poses[instants[i]];
    std::vector<ReferenceNiche>& niches = truth[instants[i]];
    niches = referenceNiches(pair, pose, truthCutoff(pair, pose), kLeastProminence);
    const auto is_hidden = [&](const ReferenceNiche& niche) {
      return !isVisible(*pair.a, *pair.b, pose, niche.witness);
    };
    niches.erase(std::remove_if(niches.begin(), niches.end(), is_hidden), niches.end());
  });
  return truth;
}

// The true niches of one instant against what the tracker reports there.
void compare(const BenchmarkPair& pair, const Eigen::Isometry3d& pose,
             const std::vector<ReferenceNiche>& truth, const std::vector<WitnessPair>& found,
             bool window_starts, std::vector<Followed>& followed, Tally& tally) {
  RefinementWorkspace workspace;
  const std::vector<const Followed*> before = predecessors(pair, pose, followed, truth, workspace);
  const std::vector<std::size_t> met_by = matchOverBentPasses(pair, pose, found, truth, kLeastProminence);
  const auto waits = [](const Followed& niche) { return !niche.reported && !niche.from_the_start; };
  std::vector<Followed> next;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    Followed now;
    if (before[i] != nullptr) {
      now = *before[i];
    }
    now.from_the_start = now.from_the_start || window_starts;
    now.witness = truth[i].witness;
    const bool met = met_by[i] != kNoMatch;
    tally.truths += 1.0;
    tally.recalled += met ? 1.0 : 0.0;
    if (truth[i].node_prominence >= kProminent) {
      tally.prominent_truths += 1.0;
      tally.prominent_recalled += met ? 1.0 : 0.0;
    }
    tally.born += before[i] == nullptr && !window_starts ? 1 : 0;
    if (met && waits(now)) {
      tally.latencies.push_back(now.unreported);
    }
    now.unreported += met ? 0 : 1;
    now.reported = now.reported || met;
    next.push_back(now);
  }
  followed = std::move(next);
}

Tally run(const BenchmarkPair& pair, const Windows& windows) {
  std::vector<Eigen::Isometry3d> poses;
  for (int k = 0; k < windows.steps; ++k) {
    poses.push_back(pair.motion(windows.steps > 1 ? static_cast<double>(k) / (windows.steps - 1) : 0.0));
  }
  const std::vector<std::vector<ReferenceNiche>> truth = truthOf(pair, poses, windows);
  Tally tally;
  TrackerParameters parameters;
  parameters.largest_niche_count = 1000;
  PairTracker tracker(pair.name, pair.a, pair.b, parameters);
  PairSolution solution;
  std::vector<Followed> followed;
  int window = 0;
  for (int k = 0; k < windows.steps; ++k) {
    const auto instant = static_cast<std::size_t>(k);
    tracker.update(poses[instant], 5.0 * k / windows.steps, solution);
    if (window == windows.count || k < windows.start(window)) {
      continue;
    }
    if (k == windows.start(window)) {
      followed.clear();
    }
    compare(pair, poses[instant], truth[instant], witnesses(solution), k == windows.start(window), followed,
            tally);
    if (k == (windows.start(window) + windows.end(window)) / 2) {
      TrackerParameters cold = parameters;
      cold.seed = instant + 1;
      const PairSolution fresh = solveOnce(pair.name, pair.a, pair.b, cold, poses[instant]);
      tally.cold_truths += static_cast<double>(truth[instant].size());
      for (const std::size_t match :
           matchOverBentPasses(pair, poses[instant], witnesses(fresh), truth[instant], kLeastProminence)) {
        tally.cold_recalled += match != kNoMatch ? 1.0 : 0.0;
      }
    }
    window += k + 1 == windows.end(window) ? 1 : 0;
  }
  return tally;
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  CLI::App app("Recall of true niches along motions");
  std::vector<std::string> names = allPairs();
  Windows windows{4, 10, 200};
  std::string output;
  app.add_option("--pairs", names, "Pairs to run; all when left out")->delimiter(',');
  app.add_option("--steps", windows.steps, "Instants along each motion")->check(CLI::PositiveNumber);
  app.add_option("--windows", windows.count, "Windows in which the truth is known")
      ->check(CLI::PositiveNumber);
  app.add_option("--window", windows.length, "Instants of each")->check(CLI::PositiveNumber);
  app.add_option("--output", output, "CSV file to write");
  CLI11_PARSE(app, argc, argv);

  std::ofstream csv;
  if (!output.empty()) {
    csv.open(output);
    csv << "pair,steps,observed,true_niches_mean,tracked_recall,prominent_niches_mean,prominent_recall,cold_"
           "recall,"
           "births,"
           "latency_mean,latency_p95,unreported\n";
  }
  std::printf("%-20s %8s %8s %6s %8s %8s %7s %8s %6s %10s\n", "pair", "niches", "tracked", "prom.", "tracked",
              "cold", "births", "latency", "p95", "unreported");
  for (const std::string& name : names) {
    const BenchmarkPair pair = loadBenchmarkPair(name);
    const Tally tally = run(pair, windows);
    const int observed = observedInstants(windows);
    const double niches = tally.truths / observed;
    const double latency = tally.latencies.empty() ? 0.0 : mean(tally.latencies);
    const double late = tally.latencies.empty() ? 0.0 : percentile(tally.latencies, 0.95);
    const double prominent = tally.prominent_truths / observed;
    const double prominent_recall = tally.prominent_recalled / tally.prominent_truths;
    std::printf("%-20s %8.2f %8.4f %6.2f %8.4f %8.4f %7zu %8.2f %6.0f %10d\n", name.c_str(), niches,
                tally.recalled / tally.truths, prominent, prominent_recall,
                tally.cold_recalled / tally.cold_truths, tally.latencies.size(), latency, late,
                tally.born - static_cast<int>(tally.latencies.size()));
    std::fflush(stdout);
    if (csv) {
      csv << name << ',' << windows.steps << ',' << observed << ',' << niches << ','
          << tally.recalled / tally.truths << ',' << prominent << ',' << prominent_recall << ','
          << tally.cold_recalled / tally.cold_truths << ',' << tally.latencies.size() << ',' << latency << ','
          << late << ',' << tally.born - static_cast<int>(tally.latencies.size()) << '\n';
    }
  }
  return 0;
}

}  // namespace concave_distance::benchmark
