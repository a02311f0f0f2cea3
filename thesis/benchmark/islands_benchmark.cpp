// A parallel genetic algorithm (Carretero, sec. 7.1.5): islands in threads of their own beside one
// population.
//
//   islands_benchmark [--pairs obstacle_field,wam1_wam6,kr5_bicep_palm] [--spacings 0,0.01] [--runs 20]
//                     [--instant 0.5] [--output doc/results/islands.csv]
//
// A row is a pair at one instant of its motion, a grid (longest edge as a share of the smaller diameter; 0:
// automatic) and a method, the mean of the runs: `one`, a population of 100 with E evaluations; `one, half`,
// with E / 2, which two islands have each; `islands`, populations of 100 or 50 each, ten migrants every fifth
// of the run; `multi-start`. E is 80,000. Recall: share of the proven niches (as descent_benchmark) that the
// minima met are refined to. ms: processor time; of islands that of the slowest one, epoch by epoch, which
// leaves out what threads cost; wall_ms: by the clock.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>

#include "base/thread_team.h"
#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/benchmark_pairs.h"
#include "benchmark/support/stopwatch.h"
#include "search/automatic_radii.h"
#include "search/grid/body_grid.h"
#include "thesis/benchmark/support/proven_niches.h"
#include "thesis/src/evaluation/island_search.h"
#include "thesis/src/evaluation/island_workspaces.h"
#include "thesis/src/evaluation/multi_start_descent.h"

namespace concave_distance::benchmark {
namespace {

constexpr std::uint64_t kEvaluations = 80000;

struct Scene {
  BenchmarkPair pair;
  double spacing;
  Eigen::Isometry3d pose;
  std::vector<TrackedNiche> niches;
};

struct Method {
  const char* name;
  std::uint32_t islands;     ///< 0: random starts
  std::uint32_t population;  ///< of an island
  std::uint64_t evaluations;
};

constexpr Method kMethods[] = {{"one", 1, 100, kEvaluations},     {"one; half", 1, 100, kEvaluations / 2},
                               {"islands", 2, 100, kEvaluations}, {"islands", 2, 50, kEvaluations},
                               {"islands", 4, 50, kEvaluations},  {"multi-start", 0, 0, kEvaluations}};

/// Sums over the runs.
struct Figures {
  double recall = 0.0;
  double evaluations = 0.0;
  double milliseconds = 0.0;
  double wall_milliseconds = 0.0;
};

Scene makeScene(const std::string& name, double spacing, double instant) {
  BenchmarkPair pair = loadBenchmarkPair(name);
  if (spacing > 0.0) {
    pair = loadBenchmarkPair(name, spacing * std::min(pair.a->diameter(), pair.b->diameter()));
  }
  for (const BodyMesh* body : {pair.a.get(), pair.b.get()})
    gridOf(*body).metric();  // made once, in no run's time
  const Eigen::Isometry3d pose = pair.motion(instant);
  std::vector<TrackedNiche> niches = provenNiches(name, pair.a, pair.b, pose);
  return {std::move(pair), spacing, pose, std::move(niches)};
}

/// One run; the minima end in the first workspace.
void tryOnce(const Scene& scene, const Method& method, std::uint64_t seed, Figures& sum) {
  const PairObjective objective(*scene.pair.a, *scene.pair.b, scene.pose);
  SearchWorkspace workspace(*scene.pair.a, *scene.pair.b);
  RandomEngine engine(seed);
  const auto start = std::chrono::steady_clock::now();
  if (method.islands == 0) {
    const std::int64_t before = threadCpuNanoseconds();
    const GeneticResult result =
        multiStartDescent(objective, 1000000000, engine, workspace, method.evaluations);
    sum.milliseconds += 1e-6 * static_cast<double>(threadCpuNanoseconds() - before);
    sum.evaluations += static_cast<double>(result.cost.evaluations);
  } else {
    IslandParameters parameters;
    parameters.islands = method.islands;
    parameters.epochs = method.islands == 1 ? 1 : 5;
    parameters.genetic.population_size = method.population * method.islands;
    parameters.genetic.max_generations = 100000;
    parameters.genetic.evaluation_limit = method.evaluations;
    IslandWorkspaces islands(*scene.pair.a, *scene.pair.b, method.islands, workspace);
    const NicheRadii radii = automaticRadii(*scene.pair.a, *scene.pair.b, parameters.genetic);
    const IslandResult result = islandSearch(objective, parameters, radii, {}, engine, islands.all());
    sum.milliseconds += 1e3 * result.slowest_seconds;
    sum.evaluations += static_cast<double>(result.genetic.cost.evaluations);
  }
  sum.wall_milliseconds += 1e-3 * microsecondsSince(start);
  sum.recall += shareMet(*scene.pair.a, *scene.pair.b, scene.pose, scene.niches, workspace.basins.minima());
}

void report(const Scene& scene, std::uint64_t runs, std::ofstream& csv) {
  for (const Method& method : kMethods) {
    Figures sum;
    for (std::uint64_t run = 0; run < runs; ++run) {
      tryOnce(scene, method, streamSeed(run, "islands_benchmark", 0), sum);
    }
    const auto n = static_cast<double>(runs);
    char line[256];
    std::snprintf(line, sizeof line, "%s,%g,%zu,%zu,%zu,%s,%u,%u,%.0f,%.3f,%.2f,%.2f",
                  scene.pair.name.c_str(), scene.spacing, gridOf(*scene.pair.a).graph().nodeCount(),
                  gridOf(*scene.pair.b).graph().nodeCount(), scene.niches.size(), method.name, method.islands,
                  method.population, sum.evaluations / n, sum.recall / n, sum.milliseconds / n,
                  sum.wall_milliseconds / n);
    std::printf("%s\n", line);
    std::fflush(stdout);
    if (csv) csv << line << '\n';
  }
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  CLI::App app("A parallel genetic algorithm beside one population");
  std::vector<std::string> pairs = {"obstacle_field", "wam1_wam6", "kr5_bicep_palm"};
  std::vector<double> spacings = {0.0, 0.01};
  std::uint64_t runs = 20;
  double instant = 0.5;
  std::string output;
  app.add_option("--pairs", pairs, "Benchmark pairs")->delimiter(',');
  app.add_option("--spacings", spacings, "Longest edges over the smaller diameter; 0: automatic")
      ->delimiter(',');
  app.add_option("--runs", runs, "Of every method");
  app.add_option("--instant", instant, "Of the motion, from 0 to 1");
  app.add_option("--output", output, "CSV file to write");
  CLI11_PARSE(app, argc, argv);
  std::ofstream csv;
  const char* header =
      "pair,spacing,nodes_a,nodes_b,niches,method,islands,population,evaluations,recall,ms,wall_ms";
  if (!output.empty()) csv.open(output);
  if (csv) csv << header << '\n';
  std::printf("%s\n", header);
  for (const std::string& name : pairs) {
    for (const double spacing : spacings) report(makeScene(name, spacing, instant), runs, csv);
  }
  return 0;
}

}  // namespace concave_distance::benchmark
