// Runs of the thesis's experiments for counting every operation that they take, not the evaluations alone:
// scripts/evaluation/count_run_flops.py runs it under callgrind, which counts between a run's two marks.
//
//   run_flops thesis/experiments/table_3_4.yaml [more ...] [--runs 3] [--meshes meshes/thesis]
//
// Prints a line a run, in the order of callgrind's dumps: experiment, row, scene, run, kflop by the thesis's
// rule (26 a point pair, 6 a constraint). The first line is of work whose count is known.
#include <valgrind/callgrind.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "base/run_tool.h"
#include "thesis/src/continuous/continuous_annealing.h"
#include "thesis/src/continuous/continuous_genetic_search.h"
#include "thesis/src/evaluation/motion_trial.h"

namespace concave_distance::evaluation {
namespace {

enum class Count { No, Yes };

/// What `work` gives, counted or not.
template <typename Work>
double perform(Count count, const Work& work) {
  if (count == Count::No) return work();
  CALLGRIND_START_INSTRUMENTATION;
  CALLGRIND_ZERO_STATS;
  const double result = work();
  CALLGRIND_DUMP_STATS;
  CALLGRIND_STOP_INSTRUMENTATION;
  return result;
}

/// 1000 multiplications, 1000 additions, 100 divisions and 10 roots.
double knownWork() {
  volatile double value = 1.5;
  for (int i = 0; i < 1000; ++i) {
    value = value * 1.000001;
    value = value + 1e-6;
    if (i % 10 == 0) value = value / 1.0000001;
    if (i % 100 == 0) value = std::sqrt(value);
  }
  return value;
}

/// By the thesis's rule, of one run. What is made outside the search (truth, records) is not counted.
double flopsOfRun(const ExperimentRow& row, const ExperimentScene& place, const SceneTruth& scene,
                  std::uint64_t seed, SearchWorkspace& workspace, Count count) {
  const Method method = row.methodOn(place);
  const Eigen::Isometry3d& a_from_b = scene.first().a_from_b;
  RandomEngine engine(seed);
  if (const auto* genetic = std::get_if<ContinuousGeneticParameters>(&method)) {
    return perform(count, [&] {
      return static_cast<double>(
          continuousGeneticSearch(*scene.tree_a, *scene.tree_b, a_from_b, *genetic, engine).cost.flops());
    });
  }
  if (const auto* annealing = std::get_if<ContinuousAnnealingParameters>(&method)) {
    return perform(count, [&] {
      return static_cast<double>(
          continuousAnnealing(*scene.tree_a, *scene.tree_b, a_from_b, *annealing, engine).cost.flops());
    });
  }
  if (place.isMotion() || !std::holds_alternative<SearchMethod>(method)) {
    return perform(count, [&] {
      return static_cast<double>(runAlong(method, row.motion, scene, seed, workspace, nullptr, 0).flops);
    });
  }
  const auto& search = std::get<SearchMethod>(method);
  const NicheRadii radii = radiiOf(scene, search);
  const PairObjective objective(*scene.a, *scene.b, a_from_b);
  workspace.basins.clear();
  return perform(count, [&] {
    return static_cast<double>(kFlopsOfAPair *
                               searchPair(objective, search, radii, engine, workspace).cost.evaluations);
  });
}

void countExperiment(const std::string& file, const std::string& meshes, std::uint32_t runs) {
  const Experiment experiment = loadExperiment(file);
  for (const ExperimentScene& place : experiment.scenes) {
    const SceneTruth scene = loadScene(place, meshes);
    SearchWorkspace workspace(*scene.a, *scene.b);
    for (const ExperimentRow& row : experiment.rows) {
      for (std::uint32_t run = 0; run < runs; ++run) {
        const std::uint64_t seed = streamSeed(experiment.seed, "evaluate", run);
        // What a body makes when it is first asked for (mesh distances) belongs to its preparation.
        flopsOfRun(row, place, scene, seed, workspace, Count::No);
        const double flops = flopsOfRun(row, place, scene, seed, workspace, Count::Yes);
        std::printf("%s,%s,%s,%zu,%u,%.3f\n", experiment.name.c_str(), row.name.c_str(), place.name.c_str(),
                    scene.instants.size(), run, 1e-3 * flops);
        std::fflush(stdout);
      }
    }
  }
}

int run(int argc, char** argv) {
  CLI::App app("Runs of experiments, for counting their operations under callgrind");
  std::vector<std::string> files;
  std::string meshes = "meshes/thesis";
  std::uint32_t runs = 3;
  app.add_option("experiments", files, "Experiment files")->required()->check(CLI::ExistingFile);
  app.add_option("--runs", runs, "Of every row on every scene")->capture_default_str();
  app.add_option("--meshes", meshes, "Folder of the meshes and poses")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  perform(Count::Yes, knownWork);
  std::printf("known,,,1,0,%.3f\n", 1e-3 * (1000 + 1000 + 100 + 10));
  for (const std::string& file : files) countExperiment(file, meshes, runs);
  return 0;
}

}  // namespace
}  // namespace concave_distance::evaluation

int main(int argc, char** argv) {
  return concave_distance::runTool("run_flops", argc, argv, concave_distance::evaluation::run);
}
