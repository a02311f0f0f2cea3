#include "search/mutation.h"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <cmath>

#include "base/constants.h"
#include "search/grid/body_grid.h"
#include "search/search_scenes.h"

namespace concave_distance::mutation_test {
namespace {

RC_GTEST_PROP(Mutation, MovesWithinTheRadiusOnTheShell, ()) {
  static const test::PairScene scene = test::facingCombs();
  PairMetric metric(*scene.a, *scene.b);
  const PairObjective objective(*scene.a, *scene.b, scene.a_from_b);
  RandomEngine engine(*rc::gen::arbitrary<std::uint64_t>());
  const double radius = *rc::gen::element(0.15, 0.3, 0.6);
  for (int i = 0; i < 20; ++i) {
    const TrialPoint point = randomTrialPoint(objective, engine);
    const TrialPoint moved = mutate(point, metric, engine, radius);
    RC_ASSERT(metric.onA().distance(point.node_a, moved.node_a) <= radius * (1.0 + 1e-6));
    RC_ASSERT(metric.onB().distance(point.node_b, moved.node_b) <= radius * (1.0 + 1e-6));
    RC_ASSERT(std::isnan(moved.squared_distance));
  }
}

TEST(Mutation, MovesOneGeneOrTheOtherOrBoth) {
  const test::PairScene scene = test::facingCombs(0.05);
  const PairObjective objective(*scene.a, *scene.b, scene.a_from_b);
  PairMetric metric(*scene.a, *scene.b);
  RandomEngine engine(21);
  int only_a = 0;
  int only_b = 0;
  int both = 0;
  constexpr int kMutations = 3000;
  for (int i = 0; i < kMutations; ++i) {
    const TrialPoint point = randomTrialPoint(objective, engine);
    const TrialPoint moved = mutate(point, metric, engine);
    const bool a = moved.node_a != point.node_a;
    const bool b = moved.node_b != point.node_b;
    only_a += a && !b ? 1 : 0;
    only_b += b && !a ? 1 : 0;
    both += a && b ? 1 : 0;
  }
  // A move shorter than the first edge stays: the three shares are a little less than a third.
  for (const int count : {only_a, only_b, both}) {
    EXPECT_GT(count, kMutations / 4);
    EXPECT_LT(count, kMutations / 3 + kMutations / 10);
  }
}

TEST(Mutation, JumpsToOtherShellsWhateverTheRadius) {
  const test::PairScene scene = test::shellsAndShells();
  const PairObjective objective(*scene.a, *scene.b, scene.a_from_b);
  PairMetric metric(*scene.a, *scene.b);
  const std::vector<std::uint32_t>& shell = gridOf(*scene.a).graph().shell;
  RandomEngine engine(22);
  int jumps = 0;
  for (int i = 0; i < 500; ++i) {
    const TrialPoint point = randomTrialPoint(objective, engine);
    const TrialPoint moved = mutate(point, metric, engine, 0.2);
    jumps += shell[moved.node_a.value] != shell[point.node_a.value] ? 1 : 0;
  }
  EXPECT_GT(jumps, 50);
}

TEST(Mutation, ReachesTheWholeBodyWithoutARadius) {
  const test::PairScene scene = test::hookAndStairs(0.3);
  const PairObjective objective(*scene.a, *scene.b, scene.a_from_b);
  PairMetric metric(*scene.a, *scene.b);
  RandomEngine engine(23);
  std::vector<bool> reached(gridOf(*scene.b).graph().nodeCount(), false);
  for (int i = 0; i < 20000; ++i) {
    reached[mutate({NodeIndex{0}, NodeIndex{0}, 0.0}, metric, engine).node_b.value] = true;
  }
  EXPECT_EQ(std::count(reached.begin(), reached.end(), false), 0);
}

}  // namespace
}  // namespace concave_distance::mutation_test
