// Recall of the true niches along motions, cycle by cycle, and how late a newborn niche is reported.
//
//   recall_benchmark [--pairs ...] [--steps 200] [--output doc/results/recall.csv]
//
// Truth: at every instant the outward niches of prominence >= 1e-2 on the grid (flood of the product graph,
// refined), cutoff 5 times the minimum or a quarter of the smaller body's diameter, whichever is larger. A
// niche counts as missed in every cycle until it is reported. Latency: cycles from the instant a true niche
// appears to the cycle that reports it, over those that appear after the first cycle and live long enough to
// be reported (lost: those that vanish first). Cold: a fresh tracker at every tenth instant.
#include <tbb/parallel_for.h>
#include <CLI/CLI.hpp>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>

#include "benchmark/support/reference_niches.h"
#include "benchmark/support/statistics.h"
#include "concave_distance/base/error.h"
#include "concave_distance/distance/enumeration.h"
#include "concave_distance/tracking/pair_tracker.h"

namespace concave_distance::benchmark {
namespace {

constexpr double kLeastProminence = 1e-2;

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
  double cold_truths = 0.0;
  double cold_recalled = 0.0;
  std::vector<double> latencies;
  int lost = 0;
};

std::vector<WitnessPair> witnesses(const PairSolution& solution) {
  std::vector<WitnessPair> found;
  for (const TrackedNiche& niche : solution.niches) {
    found.push_back(niche.witness);
  }
  return found;
}

// The entry of `followed` that has moved to `reference`, or null.
const Followed* predecessor(const BenchmarkPair& pair, const Eigen::Isometry3d& pose,
                            const std::vector<Followed>& followed, const ReferenceNiche& reference,
                            RefinementWorkspace& workspace) {
  for (const Followed& before : followed) {
    const WitnessPair now =
        refineWitness(*pair.a, *pair.b, pose, before.witness.triangle_a, before.witness.triangle_b, workspace)
            .witness;
    if (isSameNiche(pair, pose, now, reference.witness, kLeastProminence)) {
      return &before;
    }
  }
  return nullptr;
}

Tally run(const BenchmarkPair& pair, int steps) {
  std::vector<Eigen::Isometry3d> poses;
  for (int k = 0; k < steps; ++k) {
    poses.push_back(pair.motion(steps > 1 ? static_cast<double>(k) / (steps - 1) : 0.0));
  }
  std::vector<std::vector<ReferenceNiche>> truth(poses.size());
  tbb::parallel_for(std::size_t{0}, poses.size(), [&](std::size_t k) {
    const double nearest = std::sqrt(enumerateNodePairs(*pair.a, *pair.b, poses[k]).squared_distance);
    const double cutoff = std::max(5.0 * nearest, 0.25 * std::min(pair.a->diameter(), pair.b->diameter()));
    truth[k] = referenceNiches(pair, poses[k], cutoff, kLeastProminence);
  });

  Tally tally;
  TrackerParameters parameters;
  parameters.largest_niche_count = 1000;
  PairTracker tracker(pair.name, pair.a, pair.b, parameters);
  PairSolution solution;
  RefinementWorkspace workspace;
  std::vector<Followed> followed;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    tracker.update(poses[k], 5.0 * static_cast<double>(k) / static_cast<double>(poses.size()), solution);
    const std::vector<WitnessPair> found = witnesses(solution);
    std::vector<Followed> next;
    std::size_t continued = 0;
    for (const ReferenceNiche& reference : truth[k]) {
      Followed now;
      const Followed* before = predecessor(pair, poses[k], followed, reference, workspace);
      if (before != nullptr) {
        now = *before;
        continued += before->reported || before->from_the_start ? 0U : 1U;
      }
      now.from_the_start = now.from_the_start || k == 0;
      now.witness = reference.witness;
      const bool met = countRecalled(pair, poses[k], found, {reference}, kLeastProminence) == 1;
      tally.truths += 1.0;
      tally.recalled += met ? 1.0 : 0.0;
      if (met && !now.reported && !now.from_the_start) {
        tally.latencies.push_back(now.unreported);
      }
      now.unreported += met ? 0 : 1;
      now.reported = now.reported || met;
      next.push_back(now);
    }
    std::size_t waiting = 0;
    for (const Followed& before : followed) {
      waiting += before.reported || before.from_the_start ? 0U : 1U;
    }
    tally.lost += waiting > continued ? static_cast<int>(waiting - continued) : 0;
    followed = std::move(next);
    if (k % 10 == 0) {
      TrackerParameters cold = parameters;
      cold.seed = k + 1;
      const PairSolution fresh = solveOnce(pair.name, pair.a, pair.b, cold, poses[k]);
      tally.cold_truths += static_cast<double>(truth[k].size());
      tally.cold_recalled +=
          static_cast<double>(countRecalled(pair, poses[k], witnesses(fresh), truth[k], kLeastProminence));
    }
  }
  return tally;
}

int main(int argc, char** argv) {
  CLI::App app("Recall of true niches along motions");
  std::vector<std::string> names = allPairs();
  int steps = 200;
  std::string output;
  app.add_option("--pairs", names, "Pairs to run; all when left out")->delimiter(',');
  app.add_option("--steps", steps, "Instants along each motion")->check(CLI::PositiveNumber);
  app.add_option("--output", output, "CSV file to write");
  CLI11_PARSE(app, argc, argv);

  std::ofstream csv;
  if (!output.empty()) {
    csv.open(output);
    csv << "pair,steps,true_niches_mean,tracked_recall,cold_recall,births,latency_mean,latency_p95,lost\n";
  }
  std::printf("%-20s %8s %8s %8s %7s %8s %6s %5s\n", "pair", "niches", "tracked", "cold", "births", "latency",
              "p95", "lost");
  for (const std::string& name : names) {
    const BenchmarkPair pair = loadBenchmarkPair(name);
    const Tally tally = run(pair, steps);
    const double niches = tally.truths / steps;
    const double latency = tally.latencies.empty() ? 0.0 : mean(tally.latencies);
    const double late = tally.latencies.empty() ? 0.0 : percentile(tally.latencies, 0.95);
    std::printf("%-20s %8.2f %8.4f %8.4f %7zu %8.2f %6.0f %5d\n", name.c_str(), niches,
                tally.recalled / tally.truths, tally.cold_recalled / tally.cold_truths,
                tally.latencies.size(), latency, late, tally.lost);
    std::fflush(stdout);
    if (csv) {
      csv << name << ',' << steps << ',' << niches << ',' << tally.recalled / tally.truths << ','
          << tally.cold_recalled / tally.cold_truths << ',' << tally.latencies.size() << ',' << latency << ','
          << late << ',' << tally.lost << '\n';
    }
  }
  return 0;
}

}  // namespace
}  // namespace concave_distance::benchmark

int main(int argc, char** argv) {
  try {
    return concave_distance::benchmark::main(argc, argv);
  } catch (const concave_distance::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
