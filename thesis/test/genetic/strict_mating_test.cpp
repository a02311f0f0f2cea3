#include "thesis/src/genetic/strict_mating.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "search/search_fixtures.h"
#include "search/selection.h"

namespace concave_distance::strict_mating_test {
namespace {

TEST(StrictMating, LeavesStrangersOnlyWhereNobodyBehindIsNear) {
  constexpr double kRadius = 0.5;
  RandomEngine engine(64);
  test::SharedPopulation population;
  population.fill(40, 40, engine);
  const auto near = [&](std::uint32_t i, std::uint32_t j) {
    return population.places.delta(population.where[i], population.where[j], population.metric) <= kRadius;
  };
  for (int run = 0; run < 100; ++run) {
    std::vector<std::uint32_t> pool(40);
    for (std::uint32_t i = 0; i < 40; ++i) {
      pool[i] = i;
    }
    shuffle(pool, engine);
    const std::uint32_t first_parent = pool[0];
    restrictMatingStrictly(pool, population.where, kRadius, population.places, population.metric);
    EXPECT_EQ(pool[0], first_parent);
    for (std::size_t first = 0; first < pool.size(); first += 2) {
      if (near(pool[first], pool[first + 1])) continue;
      for (std::size_t behind = first + 1; behind < pool.size(); ++behind) {
        EXPECT_FALSE(near(pool[first], pool[behind]));
      }
    }
    std::sort(pool.begin(), pool.end());
    for (std::uint32_t i = 0; i < 40; ++i) {
      ASSERT_EQ(pool[i], i);
    }
  }
}

}  // namespace
}  // namespace concave_distance::strict_mating_test
