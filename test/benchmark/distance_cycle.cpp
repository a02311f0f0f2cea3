// The cycles of a pair that asks for distance alone, for counting their instructions: built once as it is,
// and once with the code that runs effects compiled out (CONCAVE_DISTANCE_WITHOUT_EFFECTS).
// scripts/measure.sh instructions runs both under callgrind, which counts within runCycles: the motion
// once more, when all buffers have grown. What a pair asks for is decided before its cycles.
//
//   distance_cycle [--pair battery_insertion] [--steps 200] [--contact]
//
// With `--contact` B is pushed into A at every instant, by 2e-3 of the smaller diameter.
#include <CLI/CLI.hpp>

#include <cstdio>
#include <optional>
#include <utility>

#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/benchmark_pairs.h"
#include "benchmark/support/pushed_in.h"
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

/// Distances of a pair that asks for no more, along a motion. run() gives their sum, metres.
struct Cycles {
  const std::vector<Eigen::Isometry3d>& poses;
  double time = 0.0;

  double run(PairTracker& tracker, PairSolution& solution) {
    double sum = 0.0;
    for (const Eigen::Isometry3d& pose : poses) {
      tracker.update(pose, time += 0.01, solution);
      sum += solution.distance;
    }
    return sum;
  }
};

/// Not inlined, so that callgrind finds it.
__attribute__((noinline)) double runCycles(PairTracker& tracker, PairSolution& solution, Cycles& cycles) {
  return cycles.run(tracker, solution);
}

#ifndef CONCAVE_DISTANCE_WITHOUT_EFFECTS
double runWithEffects(CyclePair& pair, const std::vector<Eigen::Isometry3d>& poses) {
  double sum = 0.0;
  double time = 0.0;
  for (const Eigen::Isometry3d& pose : poses) {
    pair.tracker.update(pose, time += 0.01, pair.solution);
    pair.effects->update(pair.solution, RelativeTwist(), 0.01, pair.contacts);
    sum += pair.solution.distance;
  }
  return sum;
}
#endif

double run(CyclePair& pair, const std::vector<Eigen::Isometry3d>& poses) {
#ifndef CONCAVE_DISTANCE_WITHOUT_EFFECTS
  if (pair.effects) return runWithEffects(pair, poses);
#endif
  Cycles cycles{poses};
  // Buffers grow, in a heap that is not the same in both programs.
  for (int warm_up = 0; warm_up < 2; ++warm_up) cycles.run(pair.tracker, pair.solution);
  return runCycles(pair.tracker, pair.solution, cycles);
}

int benchmarkMain(int argc, char** argv) {
  CLI::App app("Cycles that ask for distance alone");
  std::string name = "battery_insertion";
  int steps = 200;
  bool contact = false;
  app.add_option("--pair", name, "Pair to run");
  app.add_option("--steps", steps, "Instants along the motion")->check(CLI::Range(2, 1000000));
  app.add_flag("--contact", contact, "Push the bodies into each other");
  CLI11_PARSE(app, argc, argv);
  const BenchmarkPair pair = loadBenchmarkPair(name);
  const std::vector<Eigen::Isometry3d> poses =
      contact ? posesInContact(pair, steps, kUsualDepth) : posesApart(pair, steps);
  TrackerParameters parameters;
  parameters.niches_wanted = false;
  CyclePair cycle(PairTracker(pair.name, pair.a, pair.b, parameters));
  std::printf("%.17g\n", run(cycle, poses));
  return 0;
}

}  // namespace concave_distance::benchmark
