#include "search/sharing.h"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <cmath>

#include "search/grid/body_grid.h"
#include "search/search_fixtures.h"

namespace concave_distance::sharing_test {
namespace {

TEST(Sharing, ValueIsThePowerLawOfTheThesis) {
  EXPECT_DOUBLE_EQ(sharingValue(0.0, 0.6, 1.0), 1.0);
  EXPECT_DOUBLE_EQ(sharingValue(0.3, 0.6, 1.0), 0.5);
  EXPECT_DOUBLE_EQ(sharingValue(0.3, 0.6, 2.0), 0.75);
  EXPECT_DOUBLE_EQ(sharingValue(0.3, 0.6, 0.5), 1.0 - std::sqrt(0.5));
  EXPECT_DOUBLE_EQ(sharingValue(0.6, 0.6, 1.0), 0.0) << "the radius itself is outside";
  EXPECT_DOUBLE_EQ(sharingValue(std::numeric_limits<double>::infinity(), 0.6, 1.0), 0.0) << "other shells";
}

TEST(Sharing, FitnessGrowsAsTheDistanceFalls) {
  EXPECT_DOUBLE_EQ(potentialFitness(0.25, 0.0), 4.0);
  EXPECT_DOUBLE_EQ(potentialFitness(0.25, 0.5), 2.0);
  EXPECT_GT(potentialFitness(0.1, 0.05), potentialFitness(0.11, 0.05));
  EXPECT_TRUE(std::isfinite(1000.0 * potentialFitness(0.0, 0.0)));
  EXPECT_GT(potentialFitness(0.0, 0.0), potentialFitness(1e-12, 0.0));
}

TEST(Sharing, EpsilonIsTheLongestEdgeOfBothGrids) {
  const auto fine = test::makeSearchBody(test::makeLShape(), 0.1);
  const auto coarse = test::makeSearchBody(test::makeLShape(), 0.3);
  ASSERT_LT(gridOf(*fine).nodes().max_edge_length, gridOf(*coarse).nodes().max_edge_length);
  EXPECT_EQ(fitnessEpsilon(*fine, *coarse), gridOf(*coarse).nodes().max_edge_length);
  EXPECT_EQ(fitnessEpsilon(*coarse, *fine), gridOf(*coarse).nodes().max_edge_length);
}

// Table 5.19, alpha_s = 10, has 46.9/16.4/13.1/7.6/4.1 points in the first five niches of battery and
// fixture; (4.4) with this potential fitness and the node distances of Table 4.6 predicts them.
TEST(Sharing, FitnessPredictsTheNichesOfTheThesis) {
  const std::vector<double> distances{0.0757, 0.1336, 0.1499, 0.2039, 0.2953, 0.2971, 0.3731, 0.3938, 0.4026};
  double sum = 0.0;
  for (const double d : distances) {
    sum += potentialFitness(d * d, 0.0);
  }
  const std::vector<double> predicted{51.1, 16.4, 13.0, 7.0, 3.4};  // (4.4) with 1 / d^2, Table 5.19
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    EXPECT_NEAR(100.0 * potentialFitness(distances[i] * distances[i], 0.0) / sum, predicted[i], 0.1);
  }
}

RC_GTEST_PROP(Sharing, NicheCountsEqualTheSumOverAllIndividuals, ()) {
  static test::SharedPopulation population;
  RandomEngine engine(*rc::gen::arbitrary<std::uint64_t>());
  population.fill(60, *rc::gen::inRange(1U, 40U), engine);
  const double radius = *rc::gen::element(0.1, 0.5, 2.0);
  const double exponent = *rc::gen::element(0.3, 1.0, 3.0);
  std::vector<double> counts;
  nicheCounts(population.census, population.places, population.metric, radius, exponent, counts);
  for (std::uint32_t i = 0; i < population.where.size(); ++i) {
    double expected = 0.0;
    for (std::uint32_t j = 0; j < population.where.size(); ++j) {
      expected += sharingValue(population.delta(i, j), radius, exponent);
    }
    const double found = counts[population.census.entry_of_place[population.where[i]]];
    RC_ASSERT(std::abs(found - expected) <= 1e-6 * expected);  // the table keeps distances as floats
    RC_ASSERT(found >= 1.0);
  }
}

}  // namespace
}  // namespace concave_distance::sharing_test
