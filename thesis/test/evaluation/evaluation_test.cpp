#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "concave_distance/base/error.h"
#include "search/grid/body_grid.h"
#include "support/temporary_folder.h"
#include "thesis/src/evaluation/experiment.h"
#include "thesis/src/evaluation/run_experiment.h"
#include "thesis/src/evaluation/trial.h"

namespace concave_distance::evaluation::evaluation_test {
namespace {

const std::string kSource = CONCAVE_DISTANCE_SOURCE_DIR;

constexpr const char* kExperiment = R"(
title: "A small one"
runs: {quick: 10, full: 25}
niches: true
curves: true
scenes: {battery_static: 0.1}
common: {population_size: 20, max_generations: 5}
rows:
  - {name: sharing, algorithm: comb-GA-wl-sh, parameters: {niche_radius: 0.6}}
  - {name: annealing, algorithm: comb-SA-wl, parameters: {initial_temperature: 30, boltzmann_constant: 0.01}}
  - {name: continuous, algorithm: cont-GA-wl, base: ours}
)";

class Evaluation : public ::testing::Test {
 protected:
  std::string write(const std::string& yaml) {
    std::ofstream(folder_.path() + "/small.yaml") << yaml;
    return folder_.path() + "/small.yaml";
  }
  std::string output(const std::string& name) const { return folder_.path() + "/" + name; }
  EvaluationOptions options(const std::string& name, std::uint32_t runs) const {
    EvaluationOptions options;
    options.meshes = kSource + "/meshes/thesis";
    options.output = output(name);
    options.runs = runs;
    return options;
  }
  /// Lines of a results file, in order of their text, without the time.
  std::vector<std::string> linesOf(const std::string& name, const std::string& file = "small.csv") const {
    std::ifstream stream(output(name) + "/" + file);
    std::vector<std::string> lines;
    std::string header;
    std::getline(stream, header);
    std::vector<std::string> columns;
    std::istringstream names(header);
    for (std::string column; std::getline(names, column, ',');) columns.push_back(column);
    for (std::string line; std::getline(stream, line);) {
      std::istringstream cells(line);
      std::string kept;
      std::size_t i = 0;
      for (std::string cell; std::getline(cells, cell, ','); ++i) {
        if (columns[i] != "microseconds") kept += cell + ",";
      }
      lines.push_back(kept);
    }
    std::sort(lines.begin(), lines.end());
    return lines;
  }
  /// Of one row on the first scene.
  static TrialRecord runOne(const Experiment& experiment, std::size_t row, const SceneTruth& scene,
                            std::vector<CurvePoint>* curve) {
    SearchWorkspace workspace(*scene.a, *scene.b);
    return runTrials(experiment, row, 0, scene, 3, 1, workspace, curve).front();
  }
  static void run(const Experiment& experiment, const EvaluationOptions& options) {
    runExperiment(experiment, options, [](std::uint64_t, std::uint64_t) {});
  }

  test::TemporaryFolder folder_;
};

TEST_F(Evaluation, AnInterruptedOneGoesOnAndGivesWhatOneInOneGoGives) {
  const Experiment experiment = loadExperiment(write(kExperiment));
  run(experiment, options("whole", 20));
  run(experiment, options("parts", 10));
  const std::vector<std::string> first = linesOf("parts");
  EXPECT_EQ(first.size(), 30U);
  run(experiment, options("parts", 20));
  EXPECT_EQ(linesOf("parts"), linesOf("whole"));
  EXPECT_EQ(linesOf("parts", "small_curves.csv"), linesOf("whole", "small_curves.csv"));
  const auto before = std::filesystem::last_write_time(output("whole") + "/small.csv");
  run(experiment, options("whole", 20));
  EXPECT_EQ(linesOf("whole").size(), 60U);
  EXPECT_EQ(std::filesystem::last_write_time(output("whole") + "/small.csv"), before);
}

TEST_F(Evaluation, ARunWhoseLineWasCutOffIsDoneAgain) {
  const Experiment experiment = loadExperiment(write(kExperiment));
  run(experiment, options("whole", 10));
  run(experiment, options("cut", 10));
  // The end of the last line, its last cell, its middle, several lines, all but a part of the header.
  const std::string path = output("cut") + "/small.csv";
  for (const std::uintmax_t lost : {1U, 3U, 60U, 1000U, 20000U}) {
    const std::uintmax_t size = std::filesystem::file_size(path);
    std::filesystem::resize_file(path, size > lost ? size - lost : 20);
    run(experiment, options("cut", 10));
    EXPECT_EQ(linesOf("cut"), linesOf("whole")) << lost << " bytes lost";
  }
}

TEST_F(Evaluation, ACurveThatWasCutOffLeavesWholeLinesOnly) {
  const Experiment experiment = loadExperiment(write(kExperiment));
  run(experiment, options("cut", 10));
  const std::string path = output("cut") + "/small_curves.csv";
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 3);
  run(experiment, options("cut", 20));
  run(experiment, options("whole", 20));
  // One line less: nobody asks for runs again that are there.
  EXPECT_EQ(linesOf("cut", "small_curves.csv").size() + 1, linesOf("whole", "small_curves.csv").size());
  for (const std::string& line : linesOf("cut", "small_curves.csv")) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 9) << line;
  }
}

TEST_F(Evaluation, RefusesALineInTheMiddleThatIsNoWholeRun) {
  const Experiment experiment = loadExperiment(write(kExperiment));
  run(experiment, options("whole", 10));
  std::ofstream(output("whole") + "/small.csv", std::ios::app)
      << "sharing,comb-GA-wl-sh,battery_static,10,0.07\n";
  EXPECT_THROW(run(experiment, options("whole", 20)), Error);
}

TEST_F(Evaluation, ShardsTogetherAreTheWhole) {
  const Experiment experiment = loadExperiment(write(kExperiment));
  run(experiment, options("whole", 20));
  for (std::uint32_t shard = 0; shard < 3; ++shard) {
    EvaluationOptions part = options("shards", 20);
    part.shard = shard;
    part.shard_count = 3;
    run(experiment, part);
  }
  EXPECT_EQ(linesOf("shards"), linesOf("whole"));
}

TEST_F(Evaluation, MeasuresARunAsTheThesisDoes) {
  const Experiment experiment = loadExperiment(write(kExperiment));
  const SceneTruth scene = loadScene(experiment.scenes[0], kSource + "/meshes/thesis");
  std::vector<CurvePoint> curve;
  const TrialRecord record = runOne(experiment, 0, scene, &curve);
  ASSERT_EQ(curve.size(), 6U);  // the initial population and five generations
  double best = 0.0;
  double mean = 0.0;
  for (std::size_t g = 1; g < curve.size(); ++g) {
    EXPECT_LE(curve[g].best_distance, curve[g - 1].best_distance);
    best += curve[g].best_distance * curve[g].best_distance / 5.0;
    mean += curve[g].mean_square / 5.0;
  }
  const double global = scene.first().node_distance * scene.first().node_distance;
  EXPECT_NEAR(record.best_convergence, best / global, 1e-12 * best / global);  // eq. (5.1)
  EXPECT_NEAR(record.population_convergence, mean / global, 1e-12 * mean / global);
  EXPECT_GE(record.distance, scene.first().node_distance);
  EXPECT_EQ(record.exact, record.distance == scene.first().node_distance);
  EXPECT_EQ(record.region,
            record.distance < std::max(scene.first().region_limit, scene.first().node_distance * (1 + 1e-9)));
  EXPECT_EQ(record.distance, curve.back().best_distance);
  std::uint32_t members = 0;
  for (const std::uint32_t count : record.members) members += count;
  EXPECT_EQ(members, 20U);  // fewer than ten niches in a population of twenty
  EXPECT_GT(record.recall, 0.0);
  EXPECT_LE(record.recall, 1.0);
  EXPECT_LE(record.precision, 1.0);
}

TEST_F(Evaluation, MeasuresContinuousRunsByPointsInTheBodies) {
  const Experiment experiment = loadExperiment(write(kExperiment));
  const SceneTruth scene = loadScene(experiment.scenes[0], kSource + "/meshes/thesis");
  std::vector<CurvePoint> curve;
  const TrialRecord record = runOne(experiment, 2, scene, &curve);
  EXPECT_EQ(curve.size(), 6U);
  EXPECT_EQ(record.niches, 0.0);
  EXPECT_GE(record.distance, record.feasible ? scene.first().exact_distance * (1 - 1e-9) : 0.0);
  EXPECT_EQ(record.region, record.feasible && record.distance < scene.first().exact_region_limit);
  EXPECT_GT(record.flops, 26 * record.cost.evaluations);  // constraints count, too
}

TEST_F(Evaluation, KeepsTheBestPointsOfFinalPopulations) {
  const Experiment experiment = loadExperiment(write(std::string(kExperiment) + "points: true\n"));
  run(experiment, options("points", 10));
  EXPECT_EQ(linesOf("points", "small_points.csv").size(), 30U);
  const SceneTruth scene = loadScene(experiment.scenes[0], kSource + "/meshes/thesis");
  const TrialRecord annealed = runOne(experiment, 1, scene, nullptr);  // its population is its best
  EXPECT_NEAR((annealed.point_a - scene.first().a_from_b * annealed.point_b).norm(), annealed.distance,
              1e-12);
  const TrialRecord shared = runOne(experiment, 0, scene, nullptr);  // without an elite: the best may be lost
  EXPECT_GE((shared.point_a - scene.first().a_from_b * shared.point_b).norm(), shared.distance - 1e-12);
}

TEST_F(Evaluation, KeepsEveryIndividualOfTheFirstRunsFinalPopulation) {
  std::string yaml = std::string(kExperiment) + "population_points: true\n";
  EXPECT_THROW(loadExperiment(write(yaml)), Error);  // the continuous row has no node pairs
  yaml.erase(yaml.find("  - {name: continuous"),
             yaml.find("base: ours}\n") + 12 - yaml.find("  - {name: continuous"));
  EXPECT_THROW(loadExperiment(write(yaml + "points: true\n")), Error);
  const Experiment experiment = loadExperiment(write(yaml));
  run(experiment, options("population", 20));
  // Twenty individuals of the search and the best of the annealing, however many runs there are.
  EXPECT_EQ(linesOf("population", "small_points.csv").size(), 21U);
  const SceneTruth scene = loadScene(experiment.scenes[0], kSource + "/meshes/thesis");
  SearchWorkspace workspace(*scene.a, *scene.b);
  const TrialRecord first = runTrials(experiment, 0, 0, scene, 0, 2, workspace, nullptr).front();
  ASSERT_EQ(first.population.size(), 20U);
  double nearest = std::numeric_limits<double>::infinity();
  for (const IndividualPoints& pair : first.population) {
    EXPECT_NEAR((pair.point_a - scene.first().a_from_b * pair.point_b).norm(), pair.distance, 1e-12);
    nearest = std::min(nearest, pair.distance);
  }
  EXPECT_NEAR(nearest, first.niche_distances[0], 1e-12);
}

TEST_F(Evaluation, CountsWhoStandsOnTheBestPairApartFromWhoDescendsToIt) {
  const Experiment experiment = loadExperiment(write(R"(
title: "Baldwin and Lamarck"
runs: {quick: 1, full: 1}
scenes: {boxes_position_1: 0.3}
common: {population_size: 50, max_generations: 20, mutation_probability: 0.1, mating_restriction: false}
rows:
  - {name: lamarckian, algorithm: comb-GA-wl}
  - {name: baldwinian, algorithm: comb-GA-bw}
)"));
  constexpr std::uint32_t kRuns = 40;
  const SceneTruth scene = loadScene(experiment.scenes[0], kSource + "/meshes/thesis");
  const double best = scene.first().node_distance * scene.first().node_distance * (1.0 + 1e-12);
  SearchWorkspace workspace(*scene.a, *scene.b);
  for (const TrialRecord& run : runTrials(experiment, 0, 0, scene, 0, kRuns, workspace, nullptr)) {
    EXPECT_EQ(run.standing, run.exact);
  }
  const std::vector<TrialRecord> runs = runTrials(experiment, 1, 0, scene, 0, kRuns, workspace, nullptr);
  const PairObjective objective(*scene.a, *scene.b, scene.first().a_from_b);
  const auto& parameters = std::get<CombGaParameters>(std::get<SearchMethod>(experiment.rows[1].method));
  std::uint32_t descended = 0;
  std::uint32_t stood = 0;
  for (std::uint32_t i = 0; i < kRuns; ++i) {
    bool stands = false;
    RandomEngine engine(streamSeed(experiment.seed, "evaluate", i));
    workspace.basins.clear();
    combGa(objective, parameters, {1.0, 1.0, 1.0}, {}, engine, workspace,
           [&](const GenerationRecord& record) {
             for (const TrialPoint& point : *record.population) {
               stands = stands || objective.squaredDistance(point.node_a, point.node_b) <= best;
             }
           });
    EXPECT_EQ(runs[i].standing, stands) << "run " << i;
    EXPECT_LE(runs[i].standing, runs[i].exact);
    descended += runs[i].exact ? 1 : 0;
    stood += stands ? 1 : 0;
  }
  EXPECT_LT(stood, descended);
  EXPECT_GT(stood, 0U);
}

TEST_F(Evaluation, FollowsAMotion) {
  const std::string meshes = kSource + "/meshes/";
  const Experiment experiment = loadExperiment(write(R"(
title: "The battery on its way, and combs"
runs: {quick: 1, full: 1}
niches: true
scenes:
  manoeuvre: {mesh_a: )" + meshes + "thesis/fixture.stl, mesh_b: " +
                                                     meshes + "thesis/battery.stl, poses: " + meshes +
                                                     R"(thesis/manoeuvre_200.csv,
              instants: {first: 80, count: 6, step: 2}, max_edge_length: 0.1, evaluation_limit: 700, population_size: 20}
common: {max_generations: 1000}
rows:
  - {name: inherits, algorithm: comb-GA-wl-sh, base: ours}
  - {name: starts anew, algorithm: comb-GA-wl-sh, base: ours, inheritance: {limit: 0}}
  - {name: certified, algorithm: tracker}
  - {name: at nodes, algorithm: tracker, parameters: {accuracy: nodes, forgets: true}}
  - {name: all, algorithm: enumeration}
  - {name: its own limit, algorithm: multi-start, parameters: {starts: 100000, evaluation_limit: 3000}}
)"));
  const SceneTruth scene = loadScene(experiment.scenes[0], "");
  ASSERT_EQ(scene.instants.size(), 6U);
  EXPECT_NEAR(scene.instants[1].time - scene.instants[0].time, 0.2, 1e-9);  // 10 Hz, every second one
  std::vector<TrialRecord> records;
  for (std::size_t row = 0; row < experiment.rows.size(); ++row) {
    records.push_back(runOne(experiment, row, scene, nullptr));
    EXPECT_GE(records[row].recall, 0.0);
    EXPECT_LE(records[row].recall, 1.0 + 1e-12);
    EXPECT_LE(records[row].archive_recall, 1.0 + 1e-12);
    EXPECT_GE(records[row].worst_excess, -1e-9);
    EXPECT_EQ(records[row].exact, records[row].wrong_instants == 0);
  }
  EXPECT_NEAR(static_cast<double>(records[0].cost.evaluations), 700.0, 100.0);  // ends with a descent
  EXPECT_NEAR(static_cast<double>(records[5].cost.evaluations), 3000.0, 100.0);
  EXPECT_GT(records[0].archive_recall, records[1].archive_recall);
  EXPECT_TRUE(records[2].exact);
  EXPECT_EQ(records[2].recall, records[2].archive_recall);
  EXPECT_TRUE(records[4].exact);
  EXPECT_EQ(records[4].cost.evaluations,
            gridOf(*scene.a).graph().nodeCount() * gridOf(*scene.b).graph().nodeCount());
  EXPECT_EQ(records[4].flops, 26 * records[4].cost.evaluations);
}

TEST_F(Evaluation, SearchesOnOtherNodes) {
  const Experiment experiment = loadExperiment(write(R"(
title: "Other nodes"
runs: {quick: 1, full: 1}
scenes:
  mesh: {thesis_scene: battery_static, max_edge_length: 0.1}
  points: {thesis_scene: battery_static, max_edge_length: 0.1, nodes: plain_random_points}
  others: {thesis_scene: battery_static, max_edge_length: 0.1, nodes: plain_random_points, node_seed: 2}
  volume: {thesis_scene: battery_static, max_edge_length: 0.1, nodes: volume, lattice_edge: 0.06}
rows:
  - {name: search, algorithm: comb-GA-wl, parameters: {population_size: 80}}
)"));
  std::vector<SceneTruth> scenes;
  for (const ExperimentScene& scene : experiment.scenes) {
    scenes.push_back(loadScene(scene, kSource + "/meshes/thesis"));
    EXPECT_GE(scenes.back().first().node_distance, scenes.back().first().exact_distance);
    EXPECT_LT(runOne(experiment, 0, scenes.back(), nullptr).distance, 0.3);
  }
  EXPECT_EQ(gridOf(*scenes[1].a).graph().nodeCount(), gridOf(*scenes[0].a).graph().nodeCount());
  EXPECT_NE(scenes[1].first().node_distance, scenes[2].first().node_distance);
  EXPECT_EQ(scenes[3].first().node_distance, scenes[0].first().node_distance);
  EXPECT_GT(gridOf(*scenes[3].b).graph().nodeCount(), gridOf(*scenes[0].b).graph().nodeCount());
}

TEST_F(Evaluation, ReadsEveryExperimentOfThePackage) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kSource + "/thesis/experiments")) {
    if (entry.path().extension() != ".yaml") continue;
    const Experiment experiment = loadExperiment(entry.path().string());
    EXPECT_FALSE(experiment.rows.empty()) << entry.path();
    EXPECT_LE(experiment.quick_runs, experiment.full_runs) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 25U);
}

TEST_F(Evaluation, RefusesWhatIsWrongByFileLineAndKey) {
  const auto refused = [&](const std::string& from, const std::string& to, const std::string& message) {
    std::string yaml = kExperiment;
    const std::size_t at = yaml.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    yaml.replace(at, from.size(), to);
    try {
      const Experiment experiment = loadExperiment(write(yaml));
      run(experiment, options("refused", 1));
      ADD_FAILURE() << to;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
  };
  refused("comb-GA-wl-sh", "comb-GA-xl", "comb-GA-wl, -nl or -bw");
  refused("name: sharing", "name: annealing", "stands twice");
  refused("name: sharing", "name: \"a,b\"", "without commas");
  refused("battery_static: 0.1", "battery_static: 0", "greater than 0");
  refused("battery_static: 0.1", "teapot: 0.1", "is not known");
  refused("battery_static: 0.1", "a: {mesh_a: x.stl, poses: p.csv}", "mesh_b");
  refused("battery_static: 0.1", "a: {thesis_scene: battery_static, nodes: volume}", "max_edge_length");
  refused("battery_static: 0.1", "a: {mesh_a: x.stl, mesh_b: x.stl, poses: p.csv}", "constraint trees");
  refused("algorithm: comb-GA-wl-sh, parameters: {niche_radius: 0.6}",
          "algorithm: enumeration, parameters: {niche_radius: 0.6}", "no parameters");
  refused("algorithm: comb-GA-wl-sh, parameters: {niche_radius: 0.6}",
          "algorithm: tracker, parameters: {niches: 6}", "niches");
  refused("quick: 10, ", "", "quick");
  refused("niche_radius: 0.6", "niche_radius: -1", "niche_radius");
  refused("initial_temperature: 30", "temperature: 30", "temperature");
}

TEST_F(Evaluation, DoesNotWriteIntoAnotherPrograms) {
  const Experiment experiment = loadExperiment(write(kExperiment));
  std::filesystem::create_directories(output("other"));
  std::ofstream(output("other") + "/small.csv") << "a,b,c\n";
  EXPECT_THROW(run(experiment, options("other", 1)), Error);
  std::ofstream(output("other") + "/small.csv") << "a,b";
  EXPECT_THROW(run(experiment, options("other", 1)), Error);
  EXPECT_EQ(std::filesystem::file_size(output("other") + "/small.csv"), 3U);
}

}  // namespace
}  // namespace concave_distance::evaluation::evaluation_test
