#include "thesis/src/genetic/descent_moves.h"

#include <gtest/gtest.h>

#include "search/grid/body_grid.h"
#include "search/local_descent.h"
#include "search/mutation.h"
#include "search/search_scenes.h"

namespace concave_distance::descent_moves_test {
namespace {

// Parallel edges with nodes at different spacings: pairs of nodes that face each other are closest one by
// one.
TEST(DescentMoves, MovesBothNodesWhereOneAloneIsStuck) {
  const auto a = test::makeSearchBody(test::makeStairs(4), 0.05);
  const auto b = test::makeSearchBody(test::makeStairs(4), 0.06);
  // Slightly askew, so that the distance falls along the edges.
  const PairObjective objective(*a, *b, test::makePose(0.01, {0, 1, 0}, {0.02, 1.2, 0.03}));
  RandomEngine engine(5);
  std::vector<std::uint64_t> trail;
  SearchCost cost;
  int closer = 0;
  for (int i = 0; i < 300; ++i) {
    const TrialPoint start = randomTrialPoint(objective, engine);
    const TrialPoint one = descend(objective, start, nullptr, trail, cost);
    const TrialPoint both = descendBy(DescentMoves::BothNodes, objective, start, nullptr, trail, cost);
    EXPECT_TRUE(samePlace(descend(objective, both, nullptr, trail, cost), both));
    EXPECT_EQ(both.squared_distance, objective.squaredDistance(both.node_a, both.node_b));
    EXPECT_LE(both.squared_distance, one.squared_distance);
    for (const NodeGraph::Edge& edge_a : gridOf(*a).graph().edges.row(both.node_a.value)) {
      for (const NodeGraph::Edge& edge_b : gridOf(*b).graph().edges.row(both.node_b.value)) {
        EXPECT_GE(objective.squaredDistance(edge_a.to, edge_b.to), both.squared_distance);
      }
    }
    closer += both.squared_distance < one.squared_distance ? 1 : 0;
  }
  EXPECT_GT(closer, 30);
}

}  // namespace
}  // namespace concave_distance::descent_moves_test
