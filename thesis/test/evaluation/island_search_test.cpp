#include "thesis/src/evaluation/island_search.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "concave_distance/base/error.h"
#include "search/automatic_radii.h"
#include "search/search_scenes.h"
#include "thesis/src/evaluation/enumeration.h"
#include "thesis/src/evaluation/island_workspaces.h"

namespace concave_distance::island_search_test {
namespace {

bool areSame(const std::vector<TrialPoint>& l, const std::vector<TrialPoint>& r) {
  return std::equal(l.begin(), l.end(), r.begin(), r.end(),
                    [](const TrialPoint& x, const TrialPoint& y) { return samePlace(x, y); });
}

class Islands : public ::testing::Test {
 protected:
  struct Run {
    IslandResult result;
    std::vector<TrialPoint> population;
    std::vector<TrialPoint> minima;
  };
  Run run(const IslandParameters& parameters, const std::vector<TrialPoint>& inherited = {}) const {
    SearchWorkspace workspace(*scene_.a, *scene_.b);
    IslandWorkspaces islands(*scene_.a, *scene_.b, parameters.islands, workspace);
    RandomEngine engine(5);
    const NicheRadii radii = automaticRadii(*scene_.a, *scene_.b, parameters.genetic);
    IslandResult result = islandSearch(objective_, parameters, radii, inherited, engine, islands.all());
    return {result, workspace.population, workspace.basins.minima()};
  }
  static IslandParameters parametersOf(std::uint32_t islands) {
    IslandParameters parameters;
    parameters.islands = islands;
    parameters.genetic.population_size = 60;
    parameters.genetic.max_generations = 20;
    return parameters;
  }

  const test::PairScene scene_ = test::facingCombs();
  const PairObjective objective_{*scene_.a, *scene_.b, scene_.a_from_b};
};

TEST_F(Islands, GiveOneAnswerHoweverTheirThreadsRun) {
  const Run first = run(parametersOf(3));
  for (int repeat = 0; repeat < 5; ++repeat) {
    const Run again = run(parametersOf(3));
    EXPECT_EQ(again.result.genetic.cost.evaluations, first.result.genetic.cost.evaluations);
    EXPECT_TRUE(areSame(again.population, first.population));
    EXPECT_TRUE(areSame(again.minima, first.minima));
  }
}

TEST_F(Islands, FindTheBestNodePairAndKeepThePopulationsSize) {
  const double best = enumerateNodePairs(*scene_.a, *scene_.b, scene_.a_from_b).squared_distance;
  for (const std::uint32_t islands : {1U, 2U, 4U}) {
    const Run all = run(parametersOf(islands));
    EXPECT_EQ(all.result.genetic.best.squared_distance, best) << islands;
    EXPECT_EQ(all.population.size(), islands == 4 ? 56U : 60U) << "14 on each of four";
    EXPECT_EQ(all.result.genetic.generations, 20U);
    EXPECT_TRUE(std::any_of(all.minima.begin(), all.minima.end(), [&](const TrialPoint& minimum) {
      return samePlace(minimum, all.result.genetic.best);
    }));
  }
}

// Without children and immigrants only migrants bring the places of one island to another.
TEST_F(Islands, SendMigrantsRoundTheRing) {
  IslandParameters parameters = parametersOf(2);
  parameters.genetic.population_size = 40;
  parameters.genetic.max_generations = 2;
  parameters.genetic.crossover_probability = 0.0;
  parameters.genetic.mutation_probability = 0.0;
  parameters.genetic.random_immigrants = 0;
  const auto shared = [&](std::uint32_t migrants, std::uint32_t epochs) {
    parameters.migrants = migrants;
    parameters.epochs = epochs;
    const std::vector<TrialPoint> all = run(parameters).population;
    const auto half = all.begin() + 20;
    return std::count_if(all.begin(), half, [&](const TrialPoint& point) {
      return std::any_of(half, all.end(), [&](const TrialPoint& other) { return samePlace(point, other); });
    });
  };
  EXPECT_GT(shared(15, 2), shared(0, 2) + 3);
}

TEST_F(Islands, ShareTheEvaluations) {
  IslandParameters parameters = parametersOf(2);
  parameters.genetic.max_generations = 100000;
  parameters.genetic.evaluation_limit = 20000;
  const std::uint64_t evaluations = run(parameters).result.genetic.cost.evaluations;
  EXPECT_GE(evaluations, 20000U);
  EXPECT_LT(evaluations, 22000U);
}

TEST_F(Islands, DealOutWhatIsInherited) {
  IslandParameters parameters = parametersOf(2);
  parameters.genetic.max_generations = 0;
  parameters.genetic.local_optimization = LocalOptimization::None;
  std::vector<TrialPoint> inherited;
  for (std::size_t i = 0; i < 4; ++i) inherited.push_back({NodeIndex{i}, NodeIndex{2 * i}, 0.0});
  const std::vector<TrialPoint> all = run(parameters, inherited).population;
  EXPECT_TRUE(samePlace(all[0], inherited[0]) && samePlace(all[1], inherited[2]));
  EXPECT_TRUE(samePlace(all[30], inherited[1]) && samePlace(all[31], inherited[3]));
}

TEST(IslandParameters, AreRefusedByName) {
  IslandParameters parameters;
  parameters.islands = 0;
  EXPECT_THROW(parameters.validate("row"), Error);
  parameters.islands = 2;
  parameters.epochs = 0;
  EXPECT_THROW(parameters.validate("row"), Error);
}

}  // namespace
}  // namespace concave_distance::island_search_test
