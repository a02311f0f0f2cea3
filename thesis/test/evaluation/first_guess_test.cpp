#include "thesis/src/evaluation/first_guess.h"

#include <gtest/gtest.h>

#include "concave_distance/mesh/surface/primitives.h"
#include "search/grid/body_grid.h"
#include "search/grid/node_graph.h"
#include "search/search_scenes.h"
#include "thesis/src/evaluation/niche_motion.h"

namespace concave_distance::evaluation::first_guess_test {
namespace {

// Sec. 6.2.2: "two for each niche", regardless of its fitness.
TEST(FirstGuess, AFixedCountIsTheSameForEveryNiche) {
  const std::vector<TrialPoint> niches = {{NodeIndex{4}, NodeIndex{7}, 0.01},
                                          {NodeIndex{5}, NodeIndex{8}, 9.0}};
  std::vector<TrialPoint> population = {niches[0]};
  inheritFixedCount(niches, 2, population);
  ASSERT_EQ(population.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_TRUE(samePlace(population[i], niches[i / 2])) << i;
  inheritFixedCount({}, 2, population);
  EXPECT_TRUE(population.empty());
}

/// The node of a body nearest to a point, found by looking at all.
NodeIndex nearestNode(const NodeGraph& graph, const Eigen::Vector3d& point) {
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < graph.nodeCount(); ++i) {
    if ((graph.positions[i] - point).norm() < (graph.positions[nearest] - point).norm()) nearest = i;
  }
  return NodeIndex{nearest};
}

/// A bar on which niches move along x, evenly spaced nodes 0.1 apart on its top's middle line.
class MovingNiche : public ::testing::Test {
 protected:
  /// Where a niche is expected that was at these x, one an instant; on B it does not move.
  double expectedX(Extrapolation extrapolation, const std::vector<double>& places) {
    NicheMotion motion(*bar_, *bar_, extrapolation);
    PairMetric metric(*bar_, *bar_);
    const NodeGraph& graph = gridOf(*bar_).graph();
    const NodeIndex still = nearestNode(graph, {0.0, 0.0, -0.5});
    std::vector<TrialPoint> niches;
    for (const double x : places) {
      niches = {{nearestNode(graph, {x, 0.0, 0.5}), still, 1.0}};
      motion.extrapolate(10.0, metric, niches);
      EXPECT_EQ(niches[0].node_b, still);
    }
    return graph.positions[niches[0].node_a.value].x();
  }

  const std::unique_ptr<BodyMesh> bar_ = test::makeSearchBody(makeBox({8.0, 1.0, 1.0}), 0.1);
  const double edge_ = gridOf(*bar_).nodes().max_edge_length;
};

TEST_F(MovingNiche, IsLookedForWhereItsMotionLeads) {
  EXPECT_NEAR(expectedX(Extrapolation::None, {-3.0, -2.0}), -2.0, edge_);
  EXPECT_NEAR(expectedX(Extrapolation::Velocity, {-3.0}), -3.0, edge_) << "nothing is known of its motion";
  EXPECT_NEAR(expectedX(Extrapolation::Velocity, {-3.0, -2.0}), -1.0, 3.0 * edge_);
  EXPECT_NEAR(expectedX(Extrapolation::Acceleration, {-3.0, -2.0}), -1.0, 3.0 * edge_) << "velocity alone";
  // x = t^2 / 2 - 3 with t = 0, 1, 2: next 1.5, by velocity alone 0.5.
  EXPECT_NEAR(expectedX(Extrapolation::Acceleration, {-3.0, -2.5, -1.0}), 1.5, 7.0 * edge_);
  EXPECT_NEAR(expectedX(Extrapolation::Velocity, {-3.0, -2.5, -1.0}), 0.5, 3.0 * edge_);
}

TEST_F(MovingNiche, FarFromAllOfTheLastInstantIsANewOne) {
  NicheMotion motion(*bar_, *bar_, Extrapolation::Velocity);
  PairMetric metric(*bar_, *bar_);
  const NodeGraph& graph = gridOf(*bar_).graph();
  const NodeIndex first = nearestNode(graph, {-3.0, 0.0, 0.5});
  const NodeIndex second = nearestNode(graph, {3.0, 0.0, 0.5});
  std::vector<TrialPoint> niches = {{first, first, 1.0}};
  motion.extrapolate(0.5, metric, niches);
  niches = {{second, first, 1.0}};
  motion.extrapolate(0.5, metric, niches);
  EXPECT_EQ(niches[0].node_a, second);
}

}  // namespace
}  // namespace concave_distance::evaluation::first_guess_test
