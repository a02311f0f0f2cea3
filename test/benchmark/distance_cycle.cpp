// The cycles of a scene that asks for distance alone, for counting their instructions: built once as it is,
// and once with the code that runs effects compiled out (CONCAVE_DISTANCE_WITHOUT_EFFECTS).
// scripts/count_instructions.sh runs both under callgrind, which counts from the first call of runCycles on.
//
//   distance_cycle [--pair battery_insertion] [--steps 200]
#include <CLI/CLI.hpp>

#include <cstdio>
#include <optional>
#include <utility>

#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/benchmark_pairs.h"
#include "concave_distance/tracking/pair_tracker.h"
#ifndef CONCAVE_DISTANCE_WITHOUT_EFFECTS
#include "concave_distance/tracking/pair_effects.h"
#endif

namespace concave_distance::benchmark {

/// A pair as a caller keeps it who knows of effects, or does not.
struct CyclePair {
  explicit CyclePair(PairTracker made) : tracker(std::move(made)) {}

  PairTracker tracker;
  PairSolution solution;
#ifndef CONCAVE_DISTANCE_WITHOUT_EFFECTS
  std::optional<PairEffects> effects;  ///< what the settings ask for: nothing
  PairContacts contacts;
#endif
};

/// Not inlined, so that callgrind finds it. @return the sum of the distances, metres
__attribute__((noinline)) double runCycles(CyclePair& pair, const std::vector<Eigen::Isometry3d>& poses) {
  double sum = 0.0;
  double time = 0.0;
  for (const Eigen::Isometry3d& pose : poses) {
    pair.tracker.update(pose, time += 0.01, pair.solution);
#ifndef CONCAVE_DISTANCE_WITHOUT_EFFECTS
    if (pair.effects) pair.effects->update(pair.solution, RelativeTwist(), 0.01, pair.contacts);
#endif
    sum += pair.solution.distance;
  }
  return sum;
}

int benchmarkMain(int argc, char** argv) {
  CLI::App app("Cycles that ask for distance alone");
  std::string name = "battery_insertion";
  int steps = 200;
  app.add_option("--pair", name, "Pair to run");
  app.add_option("--steps", steps, "Instants along the motion")->check(CLI::Range(2, 1000000));
  CLI11_PARSE(app, argc, argv);
  const BenchmarkPair pair = loadBenchmarkPair(name);
  std::vector<Eigen::Isometry3d> poses;
  for (int k = 0; k < steps; ++k) poses.push_back(pair.motion(static_cast<double>(k) / (steps - 1)));
  TrackerParameters parameters;
  parameters.niches_wanted = false;
  CyclePair cycle(PairTracker(pair.name, pair.a, pair.b, parameters));
  std::printf("%.17g\n", runCycles(cycle, poses));
  return 0;
}

}  // namespace concave_distance::benchmark
