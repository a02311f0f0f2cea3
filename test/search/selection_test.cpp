#include "search/selection.h"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "search/search_fixtures.h"

namespace concave_distance::selection_test {
namespace {

std::vector<double> drawWeights() {
  const auto raw = *rc::gen::nonEmpty(rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 1000)));
  std::vector<double> weights(raw.begin(), raw.end());
  weights[0] += 1.0;
  return weights;
}

RC_GTEST_PROP(StochasticUniversalSampling, GivesEachIndividualFloorOrCeilOfItsExpectation, ()) {
  const std::vector<double> weights = drawWeights();
  const auto count = *rc::gen::inRange(1U, 300U);
  RandomEngine engine(*rc::gen::arbitrary<std::uint64_t>());
  std::vector<std::uint32_t> selected;
  stochasticUniversalSampling(weights, count, engine, selected);
  RC_ASSERT(selected.size() == count);
  const auto counts = test::countEach(selected, weights.size());
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double expected = count * weights[i] / sum;
    RC_ASSERT(counts[i] >= std::floor(expected - 1e-9));  // rounding of the pointers' positions
    RC_ASSERT(counts[i] <= std::ceil(expected + 1e-9));
  }
}

TEST(StochasticUniversalSampling, ManyTimesOverIsUnbiased) {
  const std::vector<double> weights{0.5, 1.5, 0.25, 3.75};
  RandomEngine engine(1);
  std::vector<double> totals(weights.size(), 0.0);
  std::vector<std::uint32_t> selected;
  constexpr int kRuns = 20000;
  for (int run = 0; run < kRuns; ++run) {
    stochasticUniversalSampling(weights, 3, engine, selected);
    for (const std::uint32_t individual : selected) {
      totals[individual] += 1.0;
    }
  }
  for (std::size_t i = 0; i < weights.size(); ++i) {
    // A count is floor or ceil, so its standard deviation is at most 1/2: four of the mean's.
    EXPECT_NEAR(totals[i] / kRuns, weights[i] * 3.0 / 6.0, 4.0 * 0.5 / std::sqrt(kRuns));
  }
}

TEST(StochasticUniversalSampling, NeverTakesAnIndividualWithoutWeight) {
  RandomEngine engine(2);
  std::vector<std::uint32_t> selected;
  for (int run = 0; run < 1000; ++run) {
    stochasticUniversalSampling({0.0, 2.0, 0.0, 1.0, 0.0}, 7, engine, selected);
    const auto counts = test::countEach(selected, 5);
    EXPECT_EQ(counts[0] + counts[2] + counts[4], 0U);
  }
}

TEST(Shuffle, PermutesAndReachesEveryOrderEquallyOften) {
  RandomEngine engine(5);
  std::vector<int> seen(6, 0);
  constexpr int kRuns = 60000;
  for (int run = 0; run < kRuns; ++run) {
    std::vector<std::uint32_t> values{0, 1, 2};
    shuffle(values, engine);
    std::vector<std::uint32_t> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    ASSERT_EQ(sorted, (std::vector<std::uint32_t>{0, 1, 2}));
    ++seen[2 * values[0] + (values[1] > values[2] ? 1 : 0)];
  }
  for (const int count : seen) {
    EXPECT_NEAR(count, kRuns / 6.0, 4.0 * std::sqrt(kRuns / 6.0));
  }
}

}  // namespace
}  // namespace concave_distance::selection_test
