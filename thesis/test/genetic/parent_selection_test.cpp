#include "thesis/src/genetic/parent_selection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "search/search_fixtures.h"

namespace concave_distance::parent_selection_test {
namespace {

TEST(RouletteWheel, TakesIndividualsInProportionToTheirWeights) {
  const std::vector<double> weights{1.0, 0.0, 3.0, 6.0};
  RandomEngine engine(3);
  std::vector<double> wheel;
  std::vector<std::uint32_t> selected;
  constexpr std::uint32_t kSpins = 100000;
  rouletteWheel(weights, kSpins, engine, wheel, selected);
  ASSERT_EQ(selected.size(), kSpins);
  const auto counts = test::countEach(selected, weights.size());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double share = weights[i] / 10.0;
    EXPECT_NEAR(counts[i] / double{kSpins}, share, 4.0 * std::sqrt(share * (1.0 - share) / kSpins));
  }
}

TEST(RouletteWheel, SpreadsMoreThanUniversalSampling) {
  const std::vector<double> weights(10, 1.0);
  RandomEngine engine(4);
  std::vector<double> wheel;
  std::vector<std::uint32_t> selected;
  const auto largest_count = [&](SelectionMethod method) {
    std::uint32_t largest = 0;
    for (int run = 0; run < 100; ++run) {
      select(method, weights, 10, engine, wheel, selected);
      const auto counts = test::countEach(selected, 10);
      largest = std::max(largest, *std::max_element(counts.begin(), counts.end()));
    }
    return largest;
  };
  EXPECT_EQ(largest_count(SelectionMethod::StochasticUniversalSampling), 1U);
  EXPECT_GT(largest_count(SelectionMethod::Roulette), 2U);
}

}  // namespace
}  // namespace concave_distance::parent_selection_test
