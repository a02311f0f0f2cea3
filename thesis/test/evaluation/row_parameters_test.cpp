#include "thesis/src/evaluation/row_parameters.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "concave_distance/base/error.h"
#include "support/temporary_folder.h"
#include "thesis/src/evaluation/experiment.h"
#include "thesis/src/genetic/comb_ga_parameter_table.h"

namespace concave_distance::evaluation::row_parameters_test {
namespace {

using Values = std::map<std::string, std::string>;

Values valuesOf(const ExperimentRow& row, const ExperimentScene& scene) {
  Values values;
  for (const auto& [name, value] : rowParameters(row, scene)) values[name] = value;
  return values;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::vector<Experiment> allExperiments() {
  std::vector<Experiment> all;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(CONCAVE_DISTANCE_SOURCE_DIR) +
                                                               "/thesis/experiments")) {
    if (entry.path().extension() == ".yaml") all.push_back(loadExperiment(entry.path().string()));
  }
  return all;
}

class Rows : public ::testing::Test {
 protected:
  Experiment experimentOf(const std::string& rows) {
    std::ofstream(folder_.path() + "/rows.yaml")
        << "title: \"Rows\"\nruns: {quick: 1, full: 1}\nscenes: {battery_static: 0.1}\n"
           "common: {population_size: 20, niche_radius: 0.6}\nrows:\n"
        << rows;
    return loadExperiment(folder_.path() + "/rows.yaml");
  }
  Values valuesOfOnly(const std::string& row) {
    const Experiment experiment = experimentOf("  - {name: row, " + row + "}\n");
    return valuesOf(experiment.rows[0], experiment.scenes[0]);
  }
  test::TemporaryFolder folder_;
};

/// What every comb-GA of the thesis has, whatever its niching.
void expectThesisGenetic(const Values& values) {
  EXPECT_EQ(values.at("elite_count"), "0");
  EXPECT_EQ(values.at("exchange_probability"), "0");
  EXPECT_EQ(values.at("random_immigrants"), "0");
  EXPECT_EQ(values.at("conserve_niches"), "false");
  EXPECT_EQ(values.at("fitness_epsilon"), "0");
  EXPECT_EQ(values.at("mutation"), "random_nodes");
  EXPECT_EQ(values.at("mating"), "mesh_near_fitter");
  EXPECT_EQ(values.at("descent_moves"), "one_node");
  EXPECT_EQ(values.at("selection"), "stochastic_universal_sampling");
  EXPECT_EQ(values.at("strict_mating_restriction"), "true");
  EXPECT_EQ(values.at("generation_gap"), "1");
  EXPECT_EQ(values.at("convergence_generations"), "0");
}

TEST_F(Rows, OfTheThesisHaveNothingOfOurOwn) {
  for (const char* algorithm :
       {"comb-GA-wl", "comb-GA-nl", "comb-GA-bw", "comb-GA-wl-sh", "comb-GA-wl-dcs"}) {
    const Values values = valuesOfOnly(std::string("algorithm: ") + algorithm);
    expectThesisGenetic(values);
    EXPECT_EQ(values.at("descend_first_population"), "false");
    EXPECT_EQ(values.at("mating_restriction"), contains(algorithm, "-sh") ? "true" : "false") << algorithm;
    EXPECT_EQ(values.at("population_size"), "20") << "from `common`";
  }
  for (const char* algorithm : {"comb-SA-wl", "comb-SA-nl"}) {
    const Values values = valuesOfOnly(std::string("algorithm: ") + algorithm);
    EXPECT_EQ(values.at("new_point_probability"), "0");
    EXPECT_EQ(values.at("move"), "random_move");
    EXPECT_EQ(values.at("variable_displacement"), "true");
    EXPECT_EQ(values.at("descent_moves"), "one_node");
  }
}

TEST_F(Rows, OfOursHaveTheDefaultsOfThisPackage) {
  const Values values = valuesOfOnly("algorithm: comb-GA-wl-sh, base: ours");
  EXPECT_EQ(values.at("elite_count"), "1");
  EXPECT_EQ(values.at("random_immigrants"), "5");
  EXPECT_EQ(values.at("exchange_probability"), "0.8");
  EXPECT_EQ(values.at("fitness_epsilon"), "1");
  EXPECT_EQ(values.at("mating"), "mesh");
  EXPECT_EQ(valuesOfOnly("algorithm: comb-SA-wl, base: ours").at("new_point_probability"), "0.35");
}

TEST_F(Rows, ThatAreShippedAreWhatTheTrackerShips) {
  const Values values = valuesOfOnly("algorithm: comb-GA-wl-sh, base: shipped");
  // TrackerParameters(): doc/expert_settings.md, `cold`.
  EXPECT_EQ(values.at("niching"), "sharing");
  EXPECT_EQ(values.at("population_size"), "60") << "not that of `common`";
  EXPECT_EQ(values.at("random_immigrants"), "20");
  EXPECT_EQ(values.at("mating_restriction"), "true");
  EXPECT_EQ(values.at("niche_radius"), "auto");
  EXPECT_THROW(experimentOf("  - {name: row, algorithm: comb-GA-wl-dc, base: shipped}\n"), Error);
  EXPECT_THROW(experimentOf("  - {name: row, algorithm: cont-GA-wl, base: shipped}\n"), Error);
}

TEST_F(Rows, OfShippedCyclesAreTheTrackersColdAndWarmSearch) {
  const Experiment experiment =
      loadExperiment(std::string(CONCAVE_DISTANCE_SOURCE_DIR) + "/thesis/experiments/options.yaml");
  const ExperimentRow& row = experiment.rows[0];
  const ExperimentScene* motion = nullptr;
  for (const ExperimentScene& scene : experiment.scenes) motion = scene.isMotion() ? &scene : motion;
  ASSERT_NE(motion, nullptr);
  const Values values = valuesOf(row, *motion);
  const TrackerParameters shipped;
  for (const Parameter<CombGaParameters>& parameter : combGaParameters()) {
    const std::string& name = parameter.info.name;
    EXPECT_EQ(values.at(name), toText(parameter.get(CombGaParameters(shipped.cold)))) << name;
    EXPECT_EQ(values.at("further." + name), toText(parameter.get(CombGaParameters(shipped.warm)))) << name;
  }
  EXPECT_EQ(values.at("inheritance.per_niche"), toText(shipped.inherited_per_niche));
  EXPECT_EQ(values.at("inheritance.limit"), std::to_string(shipped.inherited_limit));
  EXPECT_EQ(values.at("random_starts"), std::to_string(shipped.random_starts));
}

// Of thesis/experiments/options.yaml: a row changes what it names and nothing else.
TEST(ExperimentRows, OfOptionsChangeFewParameters) {
  const Experiment experiment =
      loadExperiment(std::string(CONCAVE_DISTANCE_SOURCE_DIR) + "/thesis/experiments/options.yaml");
  for (const ExperimentScene& scene : experiment.scenes) {
    const Values shipped = valuesOf(experiment.rows[0], scene);
    for (std::size_t i = 1; i < experiment.rows.size(); ++i) {
      std::size_t differences = 0;
      for (const auto& [name, value] : valuesOf(experiment.rows[i], scene)) {
        const bool is_further = name.rfind("further.", 0) == 0;
        const bool is_own = name.find("island") != std::string::npos ||
                            name.find("epochs") != std::string::npos ||
                            name.find("migrants") != std::string::npos;
        const auto known = shipped.find(name);
        differences += !is_further && !is_own && (known == shipped.end() || known->second != value) ? 1 : 0;
      }
      EXPECT_LE(differences, 3U) << experiment.rows[i].name << " on " << scene.name;
    }
  }
}

// "shipped" in a name is a promise: the defaults of src/tracking, and of a tracker no more than another
// level.
TEST(ExperimentRows, ThatSayShippedAreShipped) {
  std::size_t count = 0;
  for (const Experiment& experiment : allExperiments()) {
    for (const ExperimentRow& row : experiment.rows) {
      if (!contains(row.name, "shipped")) continue;
      ++count;
      ExperimentRow shipped = row;
      const ExperimentScene& scene = experiment.scenes[0];
      if (const auto* tracker = std::get_if<TrackerMethod>(&row.method)) {
        const Values changes = valuesOf(row, scene);
        for (const auto& [name, value] : changes) EXPECT_EQ(name, "accuracy") << row.name;
        EXPECT_TRUE(contains(row.name, tracker->parameters.accuracy == AccuracyLevel::Nodes ? "nodes"
                                       : tracker->parameters.accuracy == AccuracyLevel::Refined
                                           ? "refined"
                                           : "certified"));
      } else {
        shipped.method = SearchMethod(CombGaParameters(TrackerParameters().cold));
        EXPECT_EQ(valuesOf(row, scene), valuesOf(shipped, scene)) << experiment.name << ": " << row.name;
      }
    }
  }
  EXPECT_GE(count, 7U);
}

// Pure rows first, then the thesis's with a switch of ours, then our own.
TEST(ExperimentRows, OfTheThesisComeFirstAndArePure) {
  std::size_t count = 0;
  for (const Experiment& experiment : allExperiments()) {
    if (experiment.name.rfind("table_", 0) != 0) continue;
    const auto* search = std::get_if<SearchMethod>(&experiment.rows[0].method);
    if (search == nullptr || !std::holds_alternative<CombGaParameters>(*search)) continue;
    ++count;
    const ExperimentRow& row = experiment.rows[0];
    const Values values = valuesOf(row, experiment.scenes[0]);
    SCOPED_TRACE(experiment.name);
    EXPECT_EQ(row.base, RowBase::Thesis);
    expectThesisGenetic(values);
    const bool along_a_motion = experiment.scenes[0].isMotion();
    EXPECT_EQ(values.at("descend_first_population"), along_a_motion ? "true" : "false");
    EXPECT_EQ(values.count("inheritance.one_each"), along_a_motion ? 1U : 0U);
    EXPECT_TRUE(!along_a_motion || values.at("inheritance.one_each") == "false");
    // Table 5.15 repeats 5.14 with mating restriction and no sharing.
    const bool restricts = contains(nameOf(row.method), "-sh") || experiment.name == "table_5_15";
    EXPECT_EQ(values.at("mating_restriction"), restricts ? "true" : "false");
    bool ours_has_come = false;
    for (const ExperimentRow& other : experiment.rows) {
      ours_has_come = ours_has_come || other.base != RowBase::Thesis;
      const bool is_of_thesis =
          other.base == RowBase::Thesis && std::holds_alternative<SearchMethod>(other.method);
      EXPECT_FALSE(ours_has_come && is_of_thesis) << other.name << " stands behind what we changed";
    }
  }
  EXPECT_GE(count, 20U);
}

TEST(ExperimentRows, OfAnnealingHaveNewPointsOnlyWhereTheirNameSaysSo) {
  std::size_t count = 0;
  for (const Experiment& experiment : allExperiments()) {
    if (experiment.name.rfind("table_", 0) != 0) continue;
    for (const ExperimentRow& row : experiment.rows) {
      if (nameOf(row.method).rfind("comb-SA", 0) != 0) continue;
      ++count;
      const Values values = valuesOf(row, experiment.scenes[0]);
      EXPECT_EQ(values.at("new_point_probability"), contains(row.name, "35 % new points") ? "0.35" : "0")
          << experiment.name << ": " << row.name;
    }
  }
  EXPECT_GE(count, 20U);
}

// Of thesis/experiments/switches.yaml: a row differs from its algorithm's first by the one parameter it
// names.
TEST(ExperimentRows, OfSwitchesChangeOneParameter) {
  const Experiment experiment =
      loadExperiment(std::string(CONCAVE_DISTANCE_SOURCE_DIR) + "/thesis/experiments/switches.yaml");
  const Values* first = nullptr;
  Values pure;
  std::string algorithm;
  std::size_t count = 0;
  for (const ExperimentRow& row : experiment.rows) {
    const Values values = valuesOf(row, experiment.scenes[0]);
    if (nameOf(row.method) != algorithm) {
      algorithm = nameOf(row.method);
      pure = values;
      first = &pure;
      continue;
    }
    std::size_t differences = 0;
    for (const auto& [name, value] : values) differences += first->at(name) != value ? 1 : 0;
    if (row.base == RowBase::Thesis) {
      EXPECT_EQ(differences, 1U) << row.name;
      ++count;
    } else {
      EXPECT_GT(differences, 1U) << row.name;
    }
  }
  EXPECT_GE(count, 16U);
}

TEST_F(Rows, AreWrittenWithEveryParameter) {
  const Experiment experiment = experimentOf(
      "  - {name: search, algorithm: comb-GA-wl, parameters: {elite_count: 2}}\n"
      "  - {name: at nodes, algorithm: tracker, parameters: {accuracy: nodes}}\n");
  writeRows(experiment, folder_.path());
  std::ifstream file(folder_.path() + "/rows_rows.csv");
  std::string header;
  std::string search;
  std::string tracker;
  ASSERT_TRUE(std::getline(file, header) && std::getline(file, search) && std::getline(file, tracker));
  EXPECT_EQ(header, "row,algorithm,scene,parameters");
  EXPECT_EQ(search.rfind("search,comb-GA-wl,battery_static,population_size=20; ", 0), 0U) << search;
  EXPECT_TRUE(contains(search, "; elite_count=2;")) << search;
  EXPECT_EQ(tracker, "at nodes,tracker,battery_static,accuracy=nodes");
}

}  // namespace
}  // namespace concave_distance::evaluation::row_parameters_test
