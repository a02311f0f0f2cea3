#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "concave_distance/base/error.h"
#include "experiment.h"
#include "run_experiment.h"
#include "support/temporary_folder.h"
#include "trial.h"

namespace concave_distance::evaluation {
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
  - {name: continuous, algorithm: cont-GA-wl, base: shipped}
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
  SearchWorkspace workspace(*scene.a, *scene.b);
  std::vector<CurvePoint> curve;
  const TrialRecord record = runTrial(experiment, experiment.rows[0], scene, 3, workspace, &curve);
  ASSERT_EQ(curve.size(), 6U);  // the initial population and five generations
  double best = 0.0;
  double mean = 0.0;
  for (std::size_t g = 1; g < curve.size(); ++g) {
    EXPECT_LE(curve[g].best_distance, curve[g - 1].best_distance);
    best += curve[g].best_distance * curve[g].best_distance / 5.0;
    mean += curve[g].mean_square / 5.0;
  }
  const double global = scene.node_distance * scene.node_distance;
  EXPECT_NEAR(record.best_convergence, best / global, 1e-12 * best / global);  // eq. (5.1)
  EXPECT_NEAR(record.population_convergence, mean / global, 1e-12 * mean / global);
  EXPECT_GE(record.distance, scene.node_distance);
  EXPECT_EQ(record.exact, record.distance == scene.node_distance);
  EXPECT_EQ(record.region, record.distance < std::max(scene.region_limit, scene.node_distance * (1 + 1e-9)));
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
  SearchWorkspace workspace(*scene.a, *scene.b);
  std::vector<CurvePoint> curve;
  const TrialRecord record = runTrial(experiment, experiment.rows[2], scene, 3, workspace, &curve);
  EXPECT_EQ(curve.size(), 6U);
  EXPECT_EQ(record.niches, 0U);
  EXPECT_GE(record.distance, record.feasible ? scene.exact_distance * (1 - 1e-9) : 0.0);
  EXPECT_EQ(record.region, record.feasible && record.distance < scene.exact_region_limit);
  EXPECT_GT(record.flops, 26 * record.cost.evaluations);  // constraints count, too
}

TEST_F(Evaluation, ReadsEveryExperimentOfThePackage) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kSource + "/experiments")) {
    if (entry.path().extension() != ".yaml") continue;
    const Experiment experiment = loadExperiment(entry.path().string());
    EXPECT_FALSE(experiment.rows.empty()) << entry.path();
    EXPECT_LE(experiment.quick_runs, experiment.full_runs) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 25U);
}

TEST_F(Evaluation, ThesisRowsHaveNothingOfOurOwn) {
  const Experiment experiment = loadExperiment(write(kExperiment));
  const auto& genetic = std::get<GeneticParameters>(std::get<SearchMethod>(experiment.rows[0].method));
  EXPECT_EQ(genetic.exchange_probability, 0.0);
  EXPECT_EQ(genetic.immigrants, 0U);
  EXPECT_FALSE(genetic.conserve_niches);
  EXPECT_EQ(genetic.population_size, 20U);  // from `common`
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
}  // namespace concave_distance::evaluation
