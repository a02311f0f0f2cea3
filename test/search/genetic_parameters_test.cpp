#include "concave_distance/search/genetic_parameters.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "concave_distance/base/error.h"

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
      {"mutation_probability", "-0.1", [](auto& p) { p.mutation_probability = -0.1; }},
      {"mating_radius", "nan", [](auto& p) { p.mating_radius = kNan; }},
      {"crossover_probability", "1.5", [](auto& p) { p.crossover_probability = 1.5; }},
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

}  // namespace
}  // namespace concave_distance::genetic_parameters_test
