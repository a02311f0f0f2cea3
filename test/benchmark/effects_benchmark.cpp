// Measures what each effect costs a pair's cycle, and when it runs.
//
//   effects_benchmark [--pairs ...] [--steps 200] [--depth 2e-3] [--output doc/results/effects.csv]
//
// A pair is tracked along its motion (5 s, the first instant left out) at level `certified`, the distance
// alone asked for; after each cycle its effects run. `apart`: the motion as it is. `contact`: at every
// instant B is moved along the shortest way until it is `depth` of the smaller body's diameter inside A. A
// row is a pair, one of the two, and a combination of effects, all of them in turns at every instant so that
// noise hits all alike. Processor time of one thread, mean microseconds a cycle: `cycle`, tracker and
// effects; `effects`, these alone, with each of their stages; `runs`, the share of cycles in which the
// regions were looked for; `regions`, their mean number there.
#include <CLI/CLI.hpp>

#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/benchmark_pairs.h"
#include "benchmark/support/pushed_in.h"
#include "benchmark/support/result_table.h"
#include "benchmark/support/stopwatch.h"
#include "concave_distance/tracking/pair_effects.h"
#include "concave_distance/tracking/pair_tracker.h"

namespace concave_distance::benchmark {
namespace {

constexpr double kDuration = 5.0;  // seconds of a motion

struct Combination {
  std::string name;
  EffectSettings settings;
};

std::vector<Combination> combinations() {
  std::vector<Combination> all = {{"none", {}}, {"interference", {}}};
  all[1].settings.interference = true;
  for (const NormalForceModel model :
       {NormalForceModel::QuasiStatic, NormalForceModel::SpringDashpot, NormalForceModel::Hertz,
        NormalForceModel::HuntCrossley, NormalForceModel::ElasticFoundation}) {
    for (const FrictionModel friction :
         {FrictionModel::None, FrictionModel::RegularisedCoulomb, FrictionModel::Bristle}) {
      Combination combination{std::string(toString(model)), {}};
      if (friction != FrictionModel::None) combination.name += " + " + std::string(toString(friction));
      combination.settings.normal_force.emplace();
      combination.settings.normal_force->model = model;
      combination.settings.friction.model = friction;
      all.push_back(std::move(combination));
    }
  }
  return all;
}

/// One combination along a motion.
class Run {
 public:
  Run(const BenchmarkPair& pair, const Combination& combination)
      : effects_(pair.a, pair.b, combination.settings, inContact(Material(), Material())),
        tracker_(pair.name, pair.a, pair.b, distanceAlone()),
        asks_(combination.settings.any()) {}

  void step(const Eigen::Isometry3d& pose, double time, double step) {
    const RelativeTwist still;
    const double start = processorMicroseconds();
    tracker_.update(pose, time, solution_);
    const double between = processorMicroseconds();
    if (asks_) effects_.update(solution_, still, step, contacts_);
    const double end = processorMicroseconds();
    if (step == 0.0) {
      before_ = effects_.counts();
      return;
    }
    ++cycles_;
    cycle_ += end - start;
    alone_ += asks_ ? end - between : 0.0;
    regions_ += static_cast<double>(contacts_.regions.size());
  }

  double cycle() const { return cycle_ / cycles_; }
  double effects() const { return alone_ / cycles_; }
  double stage(EffectStage stage) const {
    const auto index = static_cast<std::size_t>(stage);
    return 1e6 * (effects_.counts().seconds[index] - before_.seconds[index]) / cycles_;
  }
  double runs(EffectStage stage) const {
    const auto index = static_cast<std::size_t>(stage);
    return static_cast<double>(effects_.counts().runs[index] - before_.runs[index]) / cycles_;
  }
  double regions() const {
    const double looked = runs(EffectStage::Interference) * cycles_;
    return looked > 0.0 ? regions_ / looked : 0.0;
  }

 private:
  static TrackerParameters distanceAlone() {
    TrackerParameters parameters;
    parameters.niches_wanted = false;
    return parameters;
  }

  PairEffects effects_;
  PairTracker tracker_;
  bool asks_;
  PairSolution solution_;
  PairContacts contacts_;
  EffectCounts before_;
  double cycles_ = 0.0;
  double cycle_ = 0.0;
  double alone_ = 0.0;
  double regions_ = 0.0;
};

void add(const std::string& pair, const char* state, const std::string& effects, const Run& run,
         const Run& none, ResultTable& table) {
  table.add(pair, state, effects, run.cycle(), run.effects(), run.stage(EffectStage::Interference),
            run.stage(EffectStage::Identity), run.stage(EffectStage::NormalForce),
            run.stage(EffectStage::Friction), run.runs(EffectStage::Interference), run.regions(),
            run.cycle() / none.cycle());
}

void runState(const BenchmarkPair& pair, const char* state, const std::vector<Eigen::Isometry3d>& poses,
              ResultTable& table) {
  const std::vector<Combination> all = combinations();
  std::vector<Run> runs;
  runs.reserve(all.size());
  for (const Combination& combination : all) runs.emplace_back(pair, combination);
  const double step = kDuration / static_cast<double>(poses.size() - 1);
  for (std::size_t k = 0; k < poses.size(); ++k) {
    for (std::size_t i = 0; i < runs.size(); ++i) {
      runs[(i + k) % runs.size()].step(poses[k], step * static_cast<double>(k), k == 0 ? 0.0 : step);
    }
  }
  for (std::size_t i = 0; i < runs.size(); ++i) add(pair.name, state, all[i].name, runs[i], runs[0], table);
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  CLI::App app("What each effect costs a cycle");
  std::vector<std::string> names = {"battery_insertion", "peg_in_hole", "comb_in_comb",
                                    "kr5_bicep_palm",    "wam3_wam5",   "stairs_leg"};
  int steps = 200;
  double depth = kUsualDepth;
  std::string output;
  app.add_option("--pairs", names, "Pairs to run")->delimiter(',');
  app.add_option("--steps", steps, "Instants along each motion")->check(CLI::Range(2, 1000000));
  app.add_option("--depth", depth, "Of the overlap, in smaller diameters")->check(CLI::PositiveNumber);
  app.add_option("--output", output, "CSV file to write");
  CLI11_PARSE(app, argc, argv);

  ResultTable table(
      output,
      "pair,state,effects,cycle_us,effects_us,interference_us,identity_us,normal_force_us,friction_us,runs,"
      "regions,cycle_over_none");
  for (const std::string& name : names) {
    const BenchmarkPair pair = loadBenchmarkPair(name);
    runState(pair, "apart", posesApart(pair, steps), table);
    runState(pair, "contact", posesInContact(pair, steps, depth), table);
  }
  return 0;
}

}  // namespace concave_distance::benchmark
