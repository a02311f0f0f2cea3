#include "search/mating.h"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <algorithm>
#include <cmath>

#include "search/search_fixtures.h"
#include "support/shortest_path.h"

namespace concave_distance::mating_test {
namespace {

// Delta of three nodes adds up along a shortest path but for the rounding of the matrices.
constexpr double kRounding = 0x1.0p-21;

TEST(Mating, FitterParentKeepsTheLargerShare) {
  EXPECT_DOUBLE_EQ(fitterShare(1.0, 3.0), 0.25);
  EXPECT_DOUBLE_EQ(fitterShare(2.0, 2.0), 0.5);
  EXPECT_DOUBLE_EQ(fitterShare(0.0, 2.0), 0.0);
  EXPECT_DOUBLE_EQ(fitterShare(0.0, 0.0), 0.5) << "0 / 0 of eq. (2.15) is defined";
}

TEST(Mating, ExchangedChildrenHaveOneNodeOfTheirParentAndOneOfTheirDonor) {
  const auto point = [](std::uint32_t a, std::uint32_t b) {
    return TrialPoint{NodeIndex{a}, NodeIndex{b}, 1.0};
  };
  const auto [first, second] = exchangeGenes(point(1, 2), point(3, 4), point(5, 6), point(7, 8));
  EXPECT_TRUE(samePlace(first, point(1, 4)));
  EXPECT_TRUE(samePlace(second, point(7, 6)));
  EXPECT_TRUE(std::isnan(first.squared_distance)) << "not evaluated yet";
}

RC_GTEST_PROP(MeshMating, ChildrenLieOnShortestPathsWithinTheWeightedRadii, ()) {
  static test::MeasuredPair c(test::facingCombs());
  RandomEngine engine(*rc::gen::arbitrary<std::uint64_t>());
  const TrialPoint x = c.drawPoint(engine);
  const TrialPoint y = c.drawPoint(engine);
  const auto [first, second] = mate(x, y, c.metric, engine);
  const TrialPoint& fitter = x < y ? x : y;
  const TrialPoint& other = x < y ? y : x;
  const double share = fitterShare(fitter.squared_distance, other.squared_distance);
  const auto check = [&](const MeshMetric& metric, NodeIndex from, NodeIndex to, NodeIndex child_1,
                         NodeIndex child_2) {
    const double length = metric.distance(from, to);
    for (const NodeIndex child : {child_1, child_2}) {
      const double displacement = metric.distance(from, child) + metric.distance(child, to);
      RC_ASSERT(std::abs(displacement - length) <= kRounding * length);
    }
    RC_ASSERT(metric.distance(from, child_1) <= share * length + kRounding * length);
    RC_ASSERT(metric.distance(to, child_2) <= (1.0 - share) * length + kRounding * length);
  };
  check(c.metric.onA(), fitter.node_a, other.node_a, first.node_a, second.node_a);
  check(c.metric.onB(), fitter.node_b, other.node_b, first.node_b, second.node_b);
}

TEST(MeshMating, TheTwoChildrenTogetherReachTheWholePath) {
  test::MeasuredPair c(test::hookAndStairs());
  RandomEngine engine(11);
  SearchCost cost;
  // The nodes farthest from the first: paths of several edges.
  const auto farthest = [](const MeshMetric& metric, std::size_t nodes) {
    NodeIndex far{0};
    for (std::uint32_t n = 1; n < nodes; ++n) {
      const double displacement = metric.distance(NodeIndex{0}, NodeIndex{n});
      if (std::isfinite(displacement) && displacement > metric.distance(NodeIndex{0}, far)) {
        far = NodeIndex{n};
      }
    }
    return far;
  };
  const TrialPoint x = c.objective.evaluate(NodeIndex{0}, NodeIndex{0}, cost);
  const TrialPoint y =
      c.objective.evaluate(farthest(c.metric.onA(), gridOf(*c.scene.a).graph().nodeCount()),
                           farthest(c.metric.onB(), gridOf(*c.scene.b).graph().nodeCount()), cost);
  const std::vector<NodeIndex> path =
      test::shortestPath(gridOf(*c.scene.a).graph(), std::min(x, y).node_a, std::max(x, y).node_a);
  ASSERT_GE(path.size(), 5U);
  std::vector<bool> reached(path.size(), false);
  for (int i = 0; i < 5000; ++i) {
    const auto [first, second] = mate(x, y, c.metric, engine);
    for (const NodeIndex child : {first.node_a, second.node_a}) {
      const auto found = std::find(path.begin(), path.end(), child);
      if (found != path.end()) {
        reached[static_cast<std::size_t>(found - path.begin())] = true;
      }
    }
  }
  // There may be several shortest paths; what is walked from either end covers at least two thirds of this.
  EXPECT_GE(std::count(reached.begin(), reached.end(), true),
            static_cast<std::ptrdiff_t>(2 * path.size() / 3));
}

TEST(MeshMating, ParentsOnDifferentShellsMateByCopying) {
  test::MeasuredPair c(test::shellsAndShells());
  const NodeGraph& graph_a = gridOf(*c.scene.a).graph();
  const NodeGraph& graph_b = gridOf(*c.scene.b).graph();
  ASSERT_GT(graph_a.shell_count, 1U);
  SearchCost cost;
  const TrialPoint x = c.objective.evaluate(NodeIndex{0}, NodeIndex{0}, cost);
  const auto other_shell = [](const NodeGraph& graph) {
    const auto found = std::find(graph.shell.begin(), graph.shell.end(), 1U);
    return NodeIndex{static_cast<std::size_t>(found - graph.shell.begin())};
  };
  const TrialPoint y = c.objective.evaluate(other_shell(graph_a), other_shell(graph_b), cost);
  const TrialPoint& fitter = std::min(x, y);
  const TrialPoint& other = std::max(x, y);
  RandomEngine engine(12);
  for (int i = 0; i < 20; ++i) {
    const auto [first, second] = mate(x, y, c.metric, engine);
    EXPECT_TRUE(samePlace(first, fitter));
    EXPECT_TRUE(samePlace(second, other));
  }
}

TEST(Mating, ParentsOnOnePlaceHaveTheirChildrenThere) {
  test::MeasuredPair c(test::facingCombs());
  RandomEngine engine(14);
  const TrialPoint x = c.drawPoint(engine);
  const auto [first, second] = mate(x, x, c.metric, engine);
  EXPECT_TRUE(samePlace(first, x));
  EXPECT_TRUE(samePlace(second, x));
  EXPECT_TRUE(std::isnan(first.squared_distance)) << "a child's distance is not computed yet";
}

}  // namespace
}  // namespace concave_distance::mating_test
