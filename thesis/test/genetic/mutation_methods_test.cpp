#include "thesis/src/genetic/mutation_methods.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "search/grid/body_grid.h"
#include "search/search_scenes.h"

namespace concave_distance::mutation_methods_test {
namespace {

// Sec. 3.3.2.c as the thesis's figures have it: no gene depends on the other, and none stays near.
TEST(Mutation, MakesEachGeneARandomNodeWithItsProbability) {
  const test::PairScene scene = test::facingCombs();
  PairMetric metric(*scene.a, *scene.b);
  RandomEngine engine(24);
  constexpr double kProbability = 0.3;
  constexpr int kIndividuals = 20000;
  const TrialPoint start{NodeIndex{0}, NodeIndex{0}, 1.0};
  int changed[4] = {0, 0, 0, 0};  // neither, A alone, B alone, both
  std::vector<int> reached(gridOf(*scene.b).graph().nodeCount(), 0);
  for (int i = 0; i < kIndividuals; ++i) {
    TrialPoint point = start;
    const bool mutated =
        mutateByChance(point, MutationMethod::RandomNodes, kProbability, 0.1, metric, engine);
    EXPECT_EQ(std::isnan(point.squared_distance), mutated);
    ++changed[(point.node_a != start.node_a ? 1 : 0) + (point.node_b != start.node_b ? 2 : 0)];
    if (point.node_b != start.node_b) ++reached[point.node_b.value];
  }
  // A gene is changed with p_m, but for the draws of the node that it was.
  const auto share = [](const std::unique_ptr<BodyMesh>& body) {
    return kProbability * (1.0 - 1.0 / static_cast<double>(gridOf(*body).graph().nodeCount()));
  };
  const double a = share(scene.a);
  const double b = share(scene.b);
  const double expected[4] = {(1 - a) * (1 - b), a * (1 - b), (1 - a) * b, a * b};
  for (int k = 0; k < 4; ++k) {
    const double deviation = std::sqrt(kIndividuals * expected[k] * (1 - expected[k]));
    EXPECT_NEAR(changed[k], kIndividuals * expected[k], 5 * deviation) << k;
  }
  // Every node as often: chi squared of n - 1 degrees of freedom, within five deviations of its mean.
  const double nodes = static_cast<double>(reached.size()) - 1.0;
  const double each = (changed[2] + changed[3]) / nodes;
  double chi_squared = 0.0;
  for (std::size_t i = 1; i < reached.size(); ++i)
    chi_squared += (reached[i] - each) * (reached[i] - each) / each;
  EXPECT_NEAR(chi_squared, nodes - 1.0, 5 * std::sqrt(2 * nodes));
}

TEST(Mutation, MovesAnIndividualWithItsProbability) {
  const test::PairScene scene = test::facingCombs();
  PairMetric metric(*scene.a, *scene.b);
  RandomEngine engine(25);
  int mutated = 0;
  for (int i = 0; i < 5000; ++i) {
    TrialPoint point{NodeIndex{0}, NodeIndex{0}, 1.0};
    const bool is_hit = mutateByChance(point, MutationMethod::RandomMove, 0.2, kInfinity, metric, engine);
    EXPECT_EQ(std::isnan(point.squared_distance), is_hit);
    mutated += is_hit ? 1 : 0;
  }
  EXPECT_NEAR(mutated, 1000, 5 * std::sqrt(800.0));
}

// Sec. 3.3.2.c: linear or Boltzmann; 2.3.2.c: exponential.
TEST(Mutation, RadiusFallsFromItsFirstValueAsTheCoolingSays) {
  const test::PairScene scene = test::facingCombs();
  const PairObjective objective(*scene.a, *scene.b, scene.a_from_b);
  CombGaParameters parameters;
  parameters.max_generations = 20;
  EXPECT_EQ(mutationRadius(parameters, objective, 7), kInfinity) << "anywhere on the shell";
  parameters.mutation_radius = 0.4;
  EXPECT_EQ(mutationRadius(parameters, objective, 20), 0.4);
  parameters.mutation_radius_cooling = Cooling::Linear;
  EXPECT_DOUBLE_EQ(mutationRadius(parameters, objective, 1), 0.4);
  EXPECT_DOUBLE_EQ(mutationRadius(parameters, objective, 11), 0.2);
  EXPECT_DOUBLE_EQ(mutationRadius(parameters, objective, 20), 0.02);
  parameters.mutation_radius_cooling = Cooling::Exponential;
  EXPECT_DOUBLE_EQ(mutationRadius(parameters, objective, 10), 0.4 * std::exp(-2.5));
  EXPECT_LT(mutationRadius(parameters, objective, 20), 0.004);
  parameters.mutation_radius.reset();
  parameters.mutation_radius_cooling = Cooling::Linear;
  EXPECT_DOUBLE_EQ(mutationRadius(parameters, objective, 1),
                   std::max(gridOf(*scene.a).geodesicExtent(), gridOf(*scene.b).geodesicExtent()));
}

// (2.6) with the same loss at every temperature, over its value in the first generation.
TEST(Mutation, BoltzmannCoolingIsTheAnnealingsFactorAtFallingTemperatures) {
  constexpr std::uint32_t kGenerations = 25;
  const auto p_b = [](double temperature) { return std::exp(-2.0 / (0.08 * temperature)); };  // k_B G_max = 2
  double last = 1.0;
  for (std::uint32_t g = 1; g <= kGenerations; ++g) {
    const double factor = coolingFactor(Cooling::Boltzmann, g, kGenerations);
    EXPECT_NEAR(factor, p_b(kGenerations + 1.0 - g) / p_b(kGenerations), 1e-15);
    EXPECT_TRUE(g == 1 ? factor == 1.0 : factor < last) << g;
    last = factor;
  }
}

TEST(Mutation, ProbabilityRunsLinearlyToItsFinalFactor) {
  CombGaParameters parameters;
  parameters.population_size = 50;
  parameters.max_generations = 11;
  EXPECT_DOUBLE_EQ(mutationProbability(parameters, 1), 0.02) << "Table 5.22: 1 / N_pop";
  EXPECT_DOUBLE_EQ(mutationProbability(parameters, 11), 0.02);
  parameters.mutation_probability = 0.1;
  parameters.final_mutation_probability_factor = 0.2;
  EXPECT_DOUBLE_EQ(mutationProbability(parameters, 1), 0.1);
  EXPECT_DOUBLE_EQ(mutationProbability(parameters, 6), 0.06);
  EXPECT_DOUBLE_EQ(mutationProbability(parameters, 11), 0.02);
  parameters.final_mutation_probability_factor = 100.0;
  EXPECT_DOUBLE_EQ(mutationProbability(parameters, 11), 1.0) << "a probability at most";
  parameters.final_mutation_probability_factor = 0.2;
  parameters.mutation_probability_cooling = Cooling::Boltzmann;
  EXPECT_DOUBLE_EQ(mutationProbability(parameters, 1), 0.1);
  EXPECT_DOUBLE_EQ(mutationProbability(parameters, 6),
                   0.02 + 0.08 * coolingFactor(Cooling::Boltzmann, 6, 11));
  EXPECT_NEAR(mutationProbability(parameters, 11), 0.02, 1e-5);
}

}  // namespace
}  // namespace concave_distance::mutation_methods_test
