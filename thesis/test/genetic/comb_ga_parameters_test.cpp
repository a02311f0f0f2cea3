#include "thesis/src/genetic/comb_ga_parameters.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

#include "concave_distance/base/error.h"
#include "concave_distance/tracking/tracker_parameters.h"
#include "ros/parameter_tables.h"
#include "search/genetic_parameter_table.h"
#include "thesis/src/genetic/comb_ga_parameter_table.h"

namespace concave_distance::comb_ga_parameters_test {
namespace {

TEST(CombGaParameters, AreRefusedByNameWithTheValueSeen) {
  static constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NO_THROW(CombGaParameters{}.validate("defaults"));
  struct Case {
    const char* parameter;
    const char* seen;
    std::function<void(CombGaParameters&)> spoil;
  };
  const std::vector<Case> cases{
      {"final_mutation_probability_factor", "nan",
       [](auto& p) { p.final_mutation_probability_factor = kNan; }},
      {"mutation_radius", "0", [](auto& p) { p.mutation_radius = 0.0; }},
      {"dynamic_niche_limit", "0", [](auto& p) { p.dynamic_niche_limit = 0; }},
      {"crowding_factor", "0", [](auto& p) { p.crowding_factor = 0; }},
      {"generation_gap", "0", [](auto& p) { p.generation_gap = 0.0; }},
      {"generation_gap", "1.1", [](auto& p) { p.generation_gap = 1.1; }},
      {"population_size", "7", [](auto& p) { p.population_size = 7; }},
      {"elite_count", "101", [](auto& p) { p.elite_count = 101; }},
  };
  for (const Case& c : cases) {
    CombGaParameters parameters;
    c.spoil(parameters);
    try {
      parameters.validate("row 3");
      ADD_FAILURE() << c.parameter << " was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.whatIsWrong().find(std::string(c.parameter) + " is " + c.seen), 0U)
          << error.whatIsWrong();
    }
  }
}

TEST(CombGaParameters, HaveEveryParameterOfTheCore) {
  const TrackerParameters shipped;
  for (const Parameter<GeneticParameters>& parameter : geneticParameters()) {
    const Parameter<CombGaParameters>* here = findParameter(combGaParameters(), parameter.info.name);
    ASSERT_NE(here, nullptr) << parameter.info.name;
    for (const GeneticParameters& core : {shipped.cold, shipped.warm}) {
      EXPECT_EQ(here->get(CombGaParameters(core)), parameter.get(core)) << parameter.info.name;
    }
  }
}

TEST(CombGaParameters, ThatTheCoreDoesNotHaveAreInTheDocument) {
  ParameterTable<CombGaParameters> own;
  for (const Parameter<CombGaParameters>& parameter : combGaParameters()) {
    if (findParameter(geneticParameters(), parameter.info.name) == nullptr) own.push_back(parameter);
  }
  test::expectTable("thesis/doc/experiments.md", "genetic", test::tableRows(own, false));
}

}  // namespace
}  // namespace concave_distance::comb_ga_parameters_test
