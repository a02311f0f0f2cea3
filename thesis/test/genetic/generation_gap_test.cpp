#include "thesis/src/genetic/generation_gap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace concave_distance::generation_gap_test {
namespace {

TEST(GenerationGap, TellsHowManyOffspringTakeASeat) {
  EXPECT_EQ(offspringCount(100, 1.0), 100U);
  EXPECT_EQ(offspringCount(100, 0.5), 50U);
  EXPECT_EQ(offspringCount(100, 0.31), 32U) << "even, because couples mate: 15.5 couples round to 16";
  EXPECT_EQ(offspringCount(100, 0.001), 2U) << "one couple at least";
  EXPECT_EQ(offspringCount(2, 1.0), 2U);
}

TEST(GenerationGap, SeatsAreDistinctAndEachAsLikely) {
  RandomEngine engine(41);
  std::vector<std::uint32_t> seats;
  drawSeats(10, 10, engine, seats);
  EXPECT_EQ(std::set<std::uint32_t>(seats.begin(), seats.end()).size(), 10U);
  std::vector<int> drawn(10, 0);
  constexpr int kRuns = 10000;
  for (int run = 0; run < kRuns; ++run) {
    drawSeats(10, 4, engine, seats);
    ASSERT_EQ(seats.size(), 4U);
    ASSERT_EQ(std::set<std::uint32_t>(seats.begin(), seats.end()).size(), 4U);
    for (const std::uint32_t seat : seats) {
      ++drawn[seat];
    }
  }
  for (const int count : drawn) {
    EXPECT_NEAR(count, 0.4 * kRuns, 4.0 * std::sqrt(kRuns * 0.4 * 0.6));
  }
}

}  // namespace
}  // namespace concave_distance::generation_gap_test
