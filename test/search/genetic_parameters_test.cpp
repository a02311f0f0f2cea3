#include "concave_distance/search/genetic_parameters.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "concave_distance/base/error.h"
#include "search/genetic_parameter_table.h"

namespace concave_distance::genetic_parameters_test {
namespace {

TEST(GeneticParameters, DefaultsAreValid) {
  EXPECT_NO_THROW(GeneticParameters{}.validate("defaults"));
}

TEST(GeneticParameters, AreRefusedByNameWithTheValueSeen) {
  static constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  struct Case {
    const char* parameter;
    const char* seen;
    std::function<void(GeneticParameters&)> spoil;
  };
  const std::vector<Case> cases{
      {"population_size", "7", [](auto& p) { p.population_size = 7; }},
      {"population_size", "0", [](auto& p) { p.population_size = 0; }},
      {"crossover_probability", "1.5", [](auto& p) { p.crossover_probability = 1.5; }},
      {"exchange_probability", "2", [](auto& p) { p.exchange_probability = 2.0; }},
      {"mutation_probability", "-0.1", [](auto& p) { p.mutation_probability = -0.1; }},
      {"final_mutation_probability_factor", "nan",
       [](auto& p) { p.final_mutation_probability_factor = kNan; }},
      {"mutation_radius", "0", [](auto& p) { p.mutation_radius = 0.0; }},
      {"sharing_radius", "-1", [](auto& p) { p.sharing_radius = -1.0; }},
      {"sharing_exponent", "0", [](auto& p) { p.sharing_exponent = 0.0; }},
      {"fitness_epsilon", "-0.5", [](auto& p) { p.fitness_epsilon = -0.5; }},
      {"dynamic_niche_limit", "0", [](auto& p) { p.dynamic_niche_limit = 0; }},
      {"mating_radius", "nan", [](auto& p) { p.mating_radius = kNan; }},
      {"niche_radius", "0", [](auto& p) { p.niche_radius = 0.0; }},
      {"crowding_factor", "0", [](auto& p) { p.crowding_factor = 0; }},
      {"generation_gap", "0", [](auto& p) { p.generation_gap = 0.0; }},
      {"generation_gap", "1.1", [](auto& p) { p.generation_gap = 1.1; }},
      {"elite_count", "101", [](auto& p) { p.elite_count = 101; }},
  };
  for (const Case& c : cases) {
    GeneticParameters parameters;
    c.spoil(parameters);
    try {
      parameters.validate("scene.yaml, pair 3");
      ADD_FAILURE() << c.parameter << " was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.where(), "scene.yaml, pair 3");
      EXPECT_EQ(error.whatIsWrong().find(std::string(c.parameter) + " is " + c.seen), 0U)
          << error.whatIsWrong();
      EXPECT_FALSE(error.remedy().empty());
    }
  }
}

// What experiments alone read is no promise of the node.
TEST(GeneticParameters, OfTheNodeAreThoseThatItsDefaultsUse) {
  const GeneticParameters defaults;
  for (const Parameter<GeneticParameters>& parameter : allGeneticParameters()) {
    const std::string& name = parameter.info.name;
    const Parameter<GeneticParameters>* of_node = findParameter(geneticParameters(), name);
    EXPECT_EQ(of_node == nullptr, parameter.info.is_of_experiments) << name;
    if (of_node == nullptr) continue;
    EXPECT_TRUE(isAllowed(of_node->info, parameter.get(defaults))) << name;
    for (const std::string& choice : parameter.info.experiment_choices) {
      EXPECT_TRUE(isAllowed(parameter.info, choice)) << choice;
      EXPECT_FALSE(isAllowed(of_node->info, choice)) << choice;
    }
  }
  for (const char* name : {"mating", "selection", "descend_first_population", "generation_gap",
                           "strict_mating_restriction", "mutation_radius_cooling", "mutation"}) {
    EXPECT_EQ(findParameter(geneticParameters(), name), nullptr) << name;
  }
}

}  // namespace
}  // namespace concave_distance::genetic_parameters_test
