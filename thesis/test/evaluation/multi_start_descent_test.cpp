#include "thesis/src/evaluation/multi_start_descent.h"

#include <gtest/gtest.h>

#include "search/search_scenes.h"

namespace concave_distance::multi_start_descent_test {
namespace {

TEST(MultiStartDescent, MeetsMoreMinimaWithMoreStarts) {
  const test::PairScene scene = test::facingCombs();
  const PairObjective objective(*scene.a, *scene.b, scene.a_from_b);
  SearchWorkspace workspace(*scene.a, *scene.b);
  RandomEngine engine(12);
  const GeneticResult few = multiStartDescent(objective, 20, engine, workspace);
  const std::size_t met_by_few = workspace.basins.minima().size();
  const GeneticResult more = multiStartDescent(objective, 500, engine, workspace);
  EXPECT_EQ(few.cost.descents, 20U);
  EXPECT_EQ(more.cost.descents, 500U);
  EXPECT_GT(workspace.basins.minima().size(), met_by_few);
  EXPECT_LE(more.best.squared_distance, few.best.squared_distance);
}

}  // namespace
}  // namespace concave_distance::multi_start_descent_test
