// What accuracy costs in time: error against microseconds of every level and of what the levels can be
// compared with, cold and tracked, on the thesis's scenes, links of robots and bodies of 100,000 triangles,
// with which the package was developed (`tuned`), and on links of other robots, of Debian's dart-doc (`held
// out`).
//
//   accuracy_benchmark [--pairs name,name,...] [--steps 200] [--cold 40] [--output doc/results/accuracy.csv]
//                      [--methods nodes,searches,continuous,levels,partition,fcl]
//                      [--stages-output doc/results/stages.csv]
//
// A row is a pair, a method, its setting and a mode. `cold`: nothing is known, at instants along the pair's
// motion; `tracked`: along the motion, every instant from the last. Errors are of the distance, against the
// proven one, in units of the smaller body's diameter; `gap` is how far the method's own lower bound stays
// below its distance, in the same unit (empty where it has none). Time is the query's alone, in one thread,
// the lesser of wall and processor time: median and 99th percentile, microseconds. `missed`: instants with an
// error above 1e-2. The stages' file has the mean microseconds of each stage of a warm cycle, level by level.
// `partition` (of a build with CGAL) says which pairs it leaves out and why.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "benchmark/support/accuracy_pairs.h"
#include "benchmark/support/benchmark_main.h"
#include "benchmark/support/benchmark_pairs.h"
#include "benchmark/support/stopwatch.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "distance/bound/certificate.h"
#include "search/automatic_radii.h"
#include "search/grid/body_grid.h"
#include "thesis/benchmark/support/accuracy_partition.h"
#include "thesis/benchmark/support/accuracy_rows.h"
#include "thesis/src/continuous/constraint_tree_file.h"
#include "thesis/src/continuous/continuous_annealing.h"
#include "thesis/src/continuous/continuous_genetic_search.h"
#include "thesis/src/evaluation/search_method.h"

namespace concave_distance::benchmark {
namespace {

constexpr double kDuration = Rows::kDuration;

/// A tracker's answers, cold each time or tracked.
void addTracker(Rows& rows, const BenchmarkPair& pair, const std::string& method, const std::string& setting,
                const TrackerParameters& parameters) {
  PairTracker tracker(pair.name, pair.a, pair.b, parameters);
  PairSolution solution;
  const auto solve = [&](const Eigen::Isometry3d& pose, double time) {
    const QueryClock clock;
    tracker.update(pose, time, solution);
    return Answer{solution.distance, solution.lower_bound,
                  std::min(1e6 * solution.solve_seconds, clock.microseconds())};
  };
  rows.cold(method, setting, [&](const Eigen::Isometry3d& pose, double time, bool) {
    tracker.reset();
    return solve(pose, time);
  });
  tracker.reset();
  rows.tracked(method, setting,
               [&](const Eigen::Isometry3d& pose, double time, bool) { return solve(pose, time); });
}

/// Level `nodes` as shipped, and over edge lengths, populations and generations.
void addNodes(Rows& rows, const std::string& name, const BenchmarkPair& pair) {
  TrackerParameters parameters;
  parameters.accuracy = AccuracyLevel::Nodes;
  addTracker(rows, pair, "nodes", "shipped", parameters);
  const double edge =
      std::max(gridOf(*pair.a).nodes().max_edge_length, gridOf(*pair.b).nodes().max_edge_length);
  if (name != "rings_100k") {
    // The meshes that are held out are fine already: still shorter edges take minutes.
    const double shortest = isHeldOut(name) ? 0.5 : 0.125;
    for (double scale = 4.0; scale >= shortest; scale *= 0.5) {
      addTracker(rows, loadAccuracyPair(name, scale * edge), "nodes", "edge " + number(scale * edge),
                 parameters);
    }
  }
  for (const std::uint32_t population : {20U, 50U, 100U, 200U}) {
    for (const std::uint32_t generations : {5U, 30U}) {
      parameters.cold.population_size = population;
      parameters.cold.max_generations = generations;
      addTracker(rows, pair, "nodes",
                 "N_pop " + std::to_string(population) + " G " + std::to_string(generations), parameters);
    }
  }
}

void addLevels(Rows& rows, const BenchmarkPair& pair) {
  TrackerParameters parameters;
  parameters.accuracy = AccuracyLevel::Refined;
  addTracker(rows, pair, "refined", "all niches", parameters);
  parameters.niches_wanted = false;
  addTracker(rows, pair, "refined", "distance alone", parameters);
  parameters.accuracy = AccuracyLevel::Certified;
  parameters.niches_wanted = true;
  addTracker(rows, pair, "certified", "all niches", parameters);
  parameters.niches_wanted = false;
  for (const double tolerance : {0.0, 1e-6, 1e-4, 1e-3, 1e-2, 1e-1}) {
    parameters.relative_tolerance = tolerance;
    addTracker(rows, pair, "certified", "tolerance " + number(tolerance), parameters);
  }
  parameters.relative_tolerance = 0.0;
  for (const double budget : {2e-6, 5e-6, 1e-5, 2e-5, 5e-5, 1e-4, 3e-4}) {
    parameters.time_budget = budget;
    addTracker(rows, pair, "certified", "budget " + number(1e6 * budget) + " us", parameters);
  }
}

/// Searches over nodes that no level uses.
void addSearches(Rows& rows, const BenchmarkPair& pair) {
  SearchWorkspace workspace(*pair.a, *pair.b);
  const NicheRadii radii = automaticRadii(*pair.a, *pair.b, {});
  std::uint64_t seed = 0;
  const auto add = [&](const std::string& setting, const SearchMethod& method) {
    rows.cold(nameOf(method), setting, [&](const Eigen::Isometry3d& pose, double, bool) {
      const PairObjective objective(*pair.a, *pair.b, pose);
      workspace.basins.clear();
      RandomEngine engine(++seed);
      const QueryClock clock;
      const SearchOutcome outcome = searchPair(objective, method, radii, engine, workspace);
      return Answer{std::sqrt(outcome.best.squared_distance), std::nan(""), clock.microseconds()};
    });
  };
  for (const std::uint32_t iterations : {150U, 2500U}) {
    AnnealingParameters annealing;
    annealing.initial_temperature = iterations;
    // In the thesis's scenes, whose bodies are two metres long, 0.01 (Table 5.5).
    annealing.boltzmann_constant = 0.0025 * std::pow(std::min(pair.a->diameter(), pair.b->diameter()), 2);
    add("t_ini " + std::to_string(iterations), annealing);
    annealing.local_optimization = false;
    add("t_ini " + std::to_string(iterations), annealing);
  }
  for (const std::uint32_t starts : {10U, 100U, 1000U}) {
    add(std::to_string(starts) + " starts", MultiStartParameters{starts, 0});
  }
}

/// The continuous approach, on the thesis's bodies, whose constraint trees are kept.
void addContinuous(Rows& rows, const BenchmarkPair& pair) {
  struct Bodies {
    const char* pair;
    const char* a;
    const char* b;
  };
  constexpr Bodies kBodies[] = {{"notched_boxes", "box", "notched_box"},
                                {"grooved_cylinder", "semi_extruded", "grooved_cylinder"},
                                {"battery_fixture", "fixture", "battery"},
                                {"battery_insertion", "fixture", "battery"}};
  const auto* const bodies =
      std::find_if(std::begin(kBodies), std::end(kBodies),
                   [&](const Bodies& candidate) { return pair.name == candidate.pair; });
  if (bodies == std::end(kBodies)) return;
  const auto tree_of = [](const char* body) {
    return std::string(CONCAVE_DISTANCE_SOURCE_DIR) + "/meshes/thesis/trees/" + body + ".yaml";
  };
  const ConstraintTree a = readConstraintTreeFile(tree_of(bodies->a));
  const ConstraintTree b = readConstraintTreeFile(tree_of(bodies->b));
  std::uint64_t seed = 0;
  const auto add = [&](const std::string& method, const std::string& setting, const auto& search) {
    rows.cold(method, setting, [&](const Eigen::Isometry3d& pose, double, bool) {
      RandomEngine engine(++seed);
      const QueryClock clock;
      const ContinuousResult found = search(pose, engine);
      return Answer{found.distance, std::nan(""), clock.microseconds()};
    });
  };
  const auto add_genetic = [&](const std::string& setting, const ContinuousGeneticParameters& parameters) {
    add("cont-GA-wl", setting, [&](const Eigen::Isometry3d& pose, RandomEngine& engine) {
      return continuousGeneticSearch(a, b, pose, parameters, engine);
    });
  };
  add_genetic("thesis", thesisContinuousGenetic());
  add_genetic("improved", improvedContinuousGenetic());
  add("cont-SA-wl", "improved", [&](const Eigen::Isometry3d& pose, RandomEngine& engine) {
    return continuousAnnealing(a, b, pose, improvedContinuousAnnealing(), engine);
  });
}

void addFcl(Rows& rows, const BenchmarkPair& pair) {
  TrianglePair closest{};
  const auto plain = [&](const Eigen::Isometry3d& pose, double, bool) {
    const QueryClock clock;
    const double distance = fclDistance(*pair.fcl_a, *pair.fcl_b, pose).distance;
    return Answer{std::max(0.0, distance), std::nan(""), clock.microseconds()};
  };
  rows.cold("FCL", "plain", plain);
  rows.tracked("FCL", "plain", plain);
  CertificateWorkspace workspace;
  rows.tracked("FCL", "seeded", [&](const Eigen::Isometry3d& pose, double, bool first) {
    const QueryClock clock;
    const double distance =
        first ? fclDistance(*pair.fcl_a, *pair.fcl_b, pose).distance
              : fclDistanceSeeded(*pair.fcl_a, *pair.fcl_b, pose, closest.a, closest.b).distance;
    const double taken = clock.microseconds();
    const DistanceCertificate proven = certifyDistance(*pair.a, *pair.b, pose, nullptr, 0, {}, workspace);
    closest = {proven.witness.triangle_a, proven.witness.triangle_b};
    return Answer{std::max(0.0, distance), std::nan(""), taken};
  });
}

/// Mean microseconds that each stage of a warm cycle takes; what interrupts it counts for none.
void writeStages(const BenchmarkPair& pair, int steps, std::ofstream& csv) {
  struct Setting {
    const char* name;
    AccuracyLevel level;
    bool niches;
  };
  for (const Setting& setting :
       {Setting{"nodes", AccuracyLevel::Nodes, true}, Setting{"refined", AccuracyLevel::Refined, true},
        Setting{"certified", AccuracyLevel::Certified, true},
        Setting{"certified, distance alone", AccuracyLevel::Certified, false}}) {
    TrackerParameters parameters;
    parameters.accuracy = setting.level;
    parameters.niches_wanted = setting.niches;
    PairTracker tracker(pair.name, pair.a, pair.b, parameters);
    PairSolution solution;
    StageTimes sum;
    double whole = 0.0;
    for (int k = 0; k < steps; ++k) {
      const double t = static_cast<double>(k) / (steps - 1);
      const Eigen::Isometry3d pose = pair.motion(t);
      const QueryClock clock;
      tracker.update(pose, kDuration * t, solution);
      const double share = std::min(1.0, 1e-6 * clock.microseconds() / solution.solve_seconds);
      if (k == 0) continue;
      for (std::size_t i = 0; i < kSolveStageCount; ++i) sum.seconds[i] += share * solution.stages.seconds[i];
      whole += share * solution.solve_seconds;
    }
    csv << pair.name << ',' << '"' << setting.name << '"';
    for (const double seconds : sum.seconds) csv << ',' << 1e6 * seconds / (steps - 1);
    csv << ',' << 1e6 * whole / (steps - 1) << '\n';
  }
}

}  // namespace

int benchmarkMain(int argc, char** argv) {
  CLI::App app("What accuracy costs in time");
  std::vector<std::string> names = accuracyPairs();
  for (const std::string& name : heldOutPairs()) names.push_back(name);
  int steps = 200;
  int cold = 40;
  const std::vector<std::string> kinds = {"nodes", "searches", "continuous", "levels", "partition", "fcl"};
  std::vector<std::string> methods = kinds;
  std::string output;
  std::string stages_output;
  app.add_option("--pairs", names, "Pairs to run: those above or of the benchmark pairs")->delimiter(',');
  app.add_option("--steps", steps, "Instants along each motion")->check(CLI::Range(2, 1000000));
  app.add_option("--cold", cold, "Instants of the cold queries")->check(CLI::Range(2, 1000000));
  app.add_option("--methods", methods, "Of nodes, searches, continuous, levels, partition, fcl; all")
      ->delimiter(',')
      ->check(CLI::IsMember(kinds));
  app.add_option("--output", output, "CSV file to write");
  app.add_option("--stages-output", stages_output, "CSV file to write the stages' times to");
  CLI11_PARSE(app, argc, argv);

  const auto wanted = [&](const char* kind) {
    return std::find(methods.begin(), methods.end(), kind) != methods.end();
  };
  std::ofstream stages;
  if (!stages_output.empty()) {
    stages.open(stages_output);
    stages << "pair,level";
    for (const char* name : kSolveStageNames) stages << ',' << name;
    stages << ",whole\n";
  }
  Rows rows(output, steps, cold);
  std::printf("%-21s %-22s %-28s %-8s %9s %9s %9s %9s %10s %10s %4s\n", "pair", "method", "setting", "mode",
              "error", "p99", "largest", "gap", "us", "p99", "miss");
  for (const std::string& name : names) {
    if (isHeldOut(name) && !isInstalled(name)) {
      std::printf("%-21s left out: install dart-doc (scripts/install_dependencies.sh test)\n", name.c_str());
      continue;
    }
    const BenchmarkPair pair = loadAccuracyPair(name);
    rows.begin(pair, isHeldOut(name) ? "held out" : "tuned");
    if (wanted("nodes")) addNodes(rows, name, pair);
    if (wanted("searches")) addSearches(rows, pair);
    if (wanted("continuous")) addContinuous(rows, pair);
    if (wanted("levels")) addLevels(rows, pair);
    if (wanted("partition")) addPartition(rows, pair);
    if (wanted("fcl")) addFcl(rows, pair);
    if (stages && !isHeldOut(name)) writeStages(pair, steps, stages);
  }
  return 0;
}

}  // namespace concave_distance::benchmark
