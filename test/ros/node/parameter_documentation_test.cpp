// The tables of the documents and config/ConcaveDistance.cfg are made from the declarations of the
// parameters. With CONCAVE_DISTANCE_WRITE_TABLES in the environment they are written, else compared.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <string>

#include "contact/contact_parameter_tables.h"
#include "ros/guard/guard_parameters.h"
#include "ros/node/node_parameter_table.h"
#include "ros/node/simulation_runner.h"
#include "ros/parameter_tables.h"
#include "scene/pair_parameters.h"
#include "scene/simulation_parameters.h"
#include "search/genetic_parameter_table.h"

namespace concave_distance::parameter_documentation_test {
namespace {

using test::expectTable;
using test::expectText;
using test::readText;
using test::tableRows;

TEST(ParameterDocumentation, HasTheNodesParameters) {
  expectTable("doc/parameters.md", "node", tableRows(nodeParameterTable(), false));
  expectTable("doc/parameters.md", "pair", tableRows(pairParameters(), false));
  expectTable("doc/parameters.md", "limits", tableRows(limitParameters(), false, "limits/"));
}

TEST(ParameterDocumentation, HasTheSettingsForExperts) {
  expectTable("doc/expert_settings.md", "pair", tableRows(pairParameters(), true));
  expectTable("doc/expert_settings.md", "node", tableRows(nodeParameterTable(), true));
  const TrackerParameters defaults;
  expectTable("doc/expert_settings.md", "cold",
              tableRows(geneticParameters(), false, "cold.", defaults.cold));
  ParameterTable<GeneticParameters> others;
  for (const Parameter<GeneticParameters>& parameter : geneticParameters()) {
    if (parameter.get(defaults.warm) != parameter.get(defaults.cold)) others.push_back(parameter);
  }
  expectTable("doc/expert_settings.md", "warm", tableRows(others, false, "warm.", defaults.warm));
}

TEST(ParameterDocumentation, HasWhatASceneFileSaysOfContactAndSimulation) {
  const std::string file = "doc/scene_file.md";
  expectTable(file, "material", tableRows(materialParameters(), false));
  expectTable(file, "normal_force", tableRows(normalForceParameters(), false));
  expectTable(file, "friction", tableRows(frictionParameters(), false));
  expectTable(file, "simulation", tableRows(simulationParameters(), false));
}

TEST(ParameterDocumentation, HasTheSimulationNodesParameters) {
  expectTable("doc/simulation_node.md", "simulation", tableRows(simulationNodeParameters(), false));
}

TEST(ParameterDocumentation, HasTheVelocityGuardsParameters) {
  expectTable("doc/velocity_guard.md", "velocity_guard", tableRows(guardParameterTable(), false));
}

template <typename Settings>
std::string reconfigureLines(const ParameterTable<Settings>& table) {
  std::string lines;
  for (const Parameter<Settings>& parameter : table) {
    const ParameterInfo& info = parameter.info;
    if (!info.at_run_time) continue;
    std::string value = toText(parameter.get(Settings()));
    std::string type = info.type == ParameterType::Count ? "int_t" : "double_t";
    if (!info.word.empty()) {
      type = "str_t";
      value = "\"" + value + "\"";
    } else if (info.type == ParameterType::Flag) {
      type = "bool_t";
      value[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(value[0])));
    } else if (info.type == ParameterType::Number && value.find_first_of(".e") == std::string::npos) {
      value += ".0";
    }
    const std::string sentence = std::regex_replace(info.sentence, std::regex("[`\"]"), "'");
    lines += "gen.add(\"" + info.name + "\", " + type + ", 0, \"" + sentence + "; " + allowedValues(info) +
             "\", " + value + ")\n";
  }
  return lines;
}

TEST(ParameterDocumentation, AgreesWithWhatMayChangeWhileTheNodeRuns) {
  const std::string file = "config/ConcaveDistance.cfg";
  const std::string text = readText(file);
  const std::size_t from = text.find("gen.add(");
  const std::size_t to = text.find("exit(gen.generate(");
  ASSERT_TRUE(from != std::string::npos && to != std::string::npos);
  expectText(file, text,
             text.substr(0, from) + reconfigureLines(nodeParameterTable()) +
                 reconfigureLines(pairParameters()) + text.substr(to));
}

TEST(ParameterDocumentation, LeavesFewSettingsOfAPairToUsers) {
  std::size_t users = 1;  // effects
  for (const Parameter<PairSettings>& parameter : pairParameters()) users += parameter.info.is_expert ? 0 : 1;
  EXPECT_LE(users, 12U);
}

std::set<std::string> matches(const std::string& text, const std::string& pattern) {
  std::set<std::string> found;
  const std::regex expression(pattern);
  for (std::sregex_iterator match(text.begin(), text.end(), expression), end; match != end; ++match) {
    found.insert((*match)[1]);
  }
  return found;
}

TEST(TestingDocumentation, NamesEveryRostestAndNoOther) {
  std::set<std::string> rostests;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(CONCAVE_DISTANCE_SOURCE_DIR) + "/test/ros/rostest")) {
    if (entry.path().extension() == ".test") rostests.insert(entry.path().stem());
  }
  EXPECT_GT(rostests.size(), 10U);
  EXPECT_EQ(matches(readText("doc/testing.md"), "\n\\| `(\\w+)` \\|"), rostests);
}

}  // namespace
}  // namespace concave_distance::parameter_documentation_test
