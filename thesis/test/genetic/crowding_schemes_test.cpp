#include "thesis/src/genetic/crowding_schemes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "search/search_fixtures.h"

namespace concave_distance::crowding_schemes_test {
namespace {

/// Places along the edge of one tooth: node k of A's path, always the same node of B, with distances given.
class CrowdingSchemes : public ::testing::Test, protected test::MeasuredPair {
 protected:
  CrowdingSchemes() : MeasuredPair(test::facingCombs()) {
    const NodeGraph& graph = gridOf(*scene.a).graph();
    const std::vector<double> length = pathLengthsFrom(graph, {NodeIndex{0}});
    const auto farthest = std::max_element(length.begin(), length.end());
    path_ = test::shortestPath(graph, NodeIndex{0},
                               NodeIndex{static_cast<std::size_t>(farthest - length.begin())});
  }

  Contestant at(std::size_t step, double squared_distance) {
    const TrialPoint point{path_.at(step), NodeIndex{3}, squared_distance};
    return {point, places_.placeOf(point)};
  }

  TrialPointTable places_;
  std::vector<NodeIndex> path_;
};

TEST_F(CrowdingSchemes, PairedContestTakesTheClosestPairing) {
  Contestant first = at(0, 5.0);
  Contestant second = at(6, 5.0);
  // The children are near the other parent each: crossed they compete.
  competePaired(first, second, at(5, 4.0), at(1, 6.0), places_, metric);
  EXPECT_EQ(first.point.squared_distance, 5.0) << "its rival (6) was worse";
  EXPECT_EQ(second.point.squared_distance, 4.0) << "replaced by the child near it";
  EXPECT_EQ(second.place, at(5, 4.0).place);
}

TEST_F(CrowdingSchemes, PairedContestGivesEachParentOneRival) {
  Contestant first = at(0, 5.0);
  Contestant second = at(6, 5.0);
  // Both children are near the first parent; only one may meet it.
  competePaired(first, second, at(1, 1.0), at(2, 2.0), places_, metric);
  EXPECT_EQ(first.point.squared_distance, 1.0);
  EXPECT_EQ(second.point.squared_distance, 2.0);
}

TEST_F(CrowdingSchemes, EqualFitnessReplacesNobody) {
  Contestant first = at(0, 5.0);
  Contestant second = at(6, 5.0);
  competePaired(first, second, at(1, 5.0), at(5, 5.0), places_, metric);
  EXPECT_EQ(first.place, at(0, 5.0).place);
  EXPECT_EQ(second.place, at(6, 5.0).place);
}

TEST_F(CrowdingSchemes, CloserParentContestLeavesTheOtherParentAlone) {
  Contestant first = at(0, 5.0);
  Contestant second = at(6, 5.0);
  competeWithCloserParent(first, second, at(1, 2.0), at(2, 1.0), places_, metric);
  EXPECT_EQ(first.point.squared_distance, 1.0) << "the better of both children holds the seat";
  EXPECT_EQ(second.point.squared_distance, 5.0);
}

TEST_F(CrowdingSchemes, SimpleCrowdingTakesTheSeatOfTheClosestOfItsDraw) {
  std::vector<std::uint32_t> population;
  for (std::size_t step = 0; step < 6; ++step) {
    population.push_back(at(step, 1.0).place);
  }
  const std::uint32_t child = at(5, 1.0).place;
  RandomEngine engine(31);
  // With a draw of 200 of six, everybody is in it but for a chance of 6 (5/6)^200 = 1e-15.
  EXPECT_EQ(crowdedOut(population, child, 200, places_, metric, engine), 5U);
  // With a draw of one, every seat is as likely.
  std::vector<int> taken(6, 0);
  for (int i = 0; i < 6000; ++i) {
    ++taken[crowdedOut(population, child, 1, places_, metric, engine)];
  }
  for (const int count : taken) {
    EXPECT_NEAR(count, 1000, 4.0 * std::sqrt(1000.0));
  }
}

}  // namespace
}  // namespace concave_distance::crowding_schemes_test
