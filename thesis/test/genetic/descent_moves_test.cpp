#include "thesis/src/genetic/descent_moves.h"

#include <gtest/gtest.h>

#include "search/grid/body_grid.h"
#include "search/local_descent.h"
#include "search/mutation.h"
#include "search/search_scenes.h"

namespace concave_distance::descent_moves_test {
namespace {

// On a grid fine enough for levels: where steps along edges lead, followed here one by one.
TEST(DescentMoves, AlongEdgesItMovesFromNeighbourToNeighbour) {
  const auto a = test::makeSearchBody(test::makeStairs(4), 0.04, 0);
  const auto b = test::makeSearchBody(test::makeLShape(), 0.04, 0);
  ASSERT_FALSE(gridOf(*a).nodes().levels.levels.empty());
  const PairObjective objective(*a, *b, test::makePose(0.4, {0.2, 1.0, 0.4}, {0.3, 1.4, 0.2}));
  const auto walk = [](const NodeGraph& graph, NodeIndex node, const auto& value) {
    for (bool moves = true; moves;) {
      const NodeIndex start = node;
      for (const NodeGraph::Edge& edge : graph.edges.row(start.value)) {
        if (value(edge.to) < value(node)) node = edge.to;
      }
      moves = node != start;
    }
    return node;
  };
  RandomEngine engine(6);
  std::vector<std::uint64_t> trail;
  SearchCost cost;
  int differs = 0;
  for (int i = 0; i < 300; ++i) {
    const TrialPoint start = randomTrialPoint(objective, engine);
    NodeIndex node_a = start.node_a;
    NodeIndex node_b = start.node_b;
    for (bool moves = true; moves;) {
      const NodeIndex before_a = node_a;
      const NodeIndex before_b = node_b;
      node_a =
          walk(gridOf(*a).graph(), node_a, [&](NodeIndex n) { return objective.squaredDistance(n, node_b); });
      node_b =
          walk(gridOf(*b).graph(), node_b, [&](NodeIndex n) { return objective.squaredDistance(node_a, n); });
      moves = !(node_a == before_a && node_b == before_b);
    }
    const TrialPoint edges =
        descendBy(DescentMoves::OneNodeAlongEdges, objective, start, nullptr, trail, cost);
    EXPECT_EQ(edges.node_a, node_a);
    EXPECT_EQ(edges.node_b, node_b);
    differs += samePlace(edges, descend(objective, start, nullptr, trail, cost)) ? 0 : 1;
  }
  EXPECT_GT(differs, 0) << "the grid is too coarse to tell both apart";
}

// Parallel edges with nodes at different spacings: pairs of nodes that face each other are closest one by
// one.
TEST(DescentMoves, MovesBothNodesWhereOneAloneIsStuck) {
  const auto a = test::makeSearchBody(test::makeStairs(4), 0.05, 0);
  const auto b = test::makeSearchBody(test::makeStairs(4), 0.06, 0);
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
