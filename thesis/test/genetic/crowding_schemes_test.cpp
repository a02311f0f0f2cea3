#include "thesis/src/genetic/crowding_schemes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "search/search_fixtures.h"

namespace concave_distance::crowding_schemes_test {
namespace {

using CrowdingSchemes = test::PlacesOnAPath;

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
