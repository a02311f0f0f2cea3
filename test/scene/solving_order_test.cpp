// The order in which a cycle with an end solves its pairs.
#include "scene/solving_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/random_engine.h"

namespace concave_distance::solving_order_test {
namespace {

TEST(SolvingOrder, BeginsWithTheNearest) {
  EXPECT_TRUE(isMoreUrgent({0.1, 0.0, 0}, {0.2, 0.0, 0}));
  EXPECT_FALSE(isMoreUrgent({0.2, 0.0, 0}, {0.1, 0.0, 0}));
  EXPECT_TRUE(isMoreUrgent({0.0, 0.0, 0}, {1e-9, 0.0, 0}));
}

TEST(SolvingOrder, TakesAPairForAsNearAsItsClosingSpeedBringsItSoon) {
  EXPECT_TRUE(isMoreUrgent({0.5, 4.0, 0}, {0.2, 0.0, 0})) << "0.1 m in a tenth of a second";
  EXPECT_TRUE(isMoreUrgent({0.3, 2.0, 0}, {0.3, 1.0, 0}));
  EXPECT_FALSE(isMoreUrgent({0.3, -5.0, 0}, {0.3, 0.0, 0})) << "what moves away is not taken for nearer";
  EXPECT_FALSE(isMoreUrgent({0.3, 0.0, 0}, {0.3, -5.0, 0})) << "nor for farther";
  EXPECT_FALSE(isMoreUrgent({0.3, kNotComputed, 0}, {0.3, 0.0, 0}));
}

TEST(SolvingOrder, TakesAPairWithoutADistanceForTheNearest) {
  EXPECT_TRUE(isMoreUrgent({kNotComputed, kNotComputed, 0}, {0.0, 10.0, 0}));
  EXPECT_FALSE(isMoreUrgent({0.0, 10.0, 0}, {kNotComputed, kNotComputed, 0}));
}

TEST(SolvingOrder, TakesLongListsAfterTheOthersButForThoseThatHaveWaited) {
  const auto long_list = [](double distance, std::uint32_t waited, bool owns_cycle) {
    return PairUrgency{distance, 0.0, waited, true, owns_cycle};
  };
  EXPECT_TRUE(isMoreUrgent({0.9, 0.0, 0}, long_list(0.1, 0, false)));
  EXPECT_TRUE(isMoreUrgent({0.9, 0.0, 0}, long_list(0.1, 0, true))) << "even where it owns the cycle";
  EXPECT_TRUE(isMoreUrgent(long_list(0.9, 0, true), long_list(0.1, 0, false)));
  EXPECT_TRUE(isMoreUrgent(long_list(0.1, 0, false), long_list(0.2, 0, false))) << "the nearest of equals";
  constexpr std::uint32_t kOverdue = kLongestWait * kCyclesOfLong;
  EXPECT_TRUE(isMoreUrgent({0.9, 0.0, 0}, long_list(0.1, kOverdue - 1, false)));
  EXPECT_TRUE(isMoreUrgent(long_list(0.9, kOverdue, false), {0.1, 0.0, 0}));
}

TEST(SolvingOrder, TakesTheLastListsAfterAllOthers) {
  const auto last = [](double distance, std::uint32_t waited) {
    return PairUrgency{distance, 0.0, waited, false, false, true};
  };
  constexpr std::uint32_t kOverdue = kLongestWait * kCyclesOfLong;
  EXPECT_TRUE(isMoreUrgent({0.9, 0.0, 0, true}, last(0.0, kOverdue))) << "however long they have waited";
  EXPECT_FALSE(isMoreUrgent(last(0.0, kOverdue), {0.9, 0.0, 0, true}));
  EXPECT_TRUE(isMoreUrgent(last(0.1, 0), last(0.2, 0)));
}

TEST(SolvingOrder, LetsNoPairStarve) {
  EXPECT_TRUE(isMoreUrgent({5.0, -1.0, kLongestWait}, {0.0, 9.0, kLongestWait - 1}));
  EXPECT_TRUE(isMoreUrgent({5.0, -1.0, kLongestWait + 1}, {0.0, 9.0, kLongestWait}));
  EXPECT_FALSE(isMoreUrgent({5.0, 0.0, kLongestWait - 1}, {0.0, 0.0, 0})) << "a short wait changes nothing";
  EXPECT_TRUE(isMoreUrgent({0.3, 0.0, 1}, {0.3, 0.0, 0})) << "but between equals";
  // One pair a cycle has its turn: none waits longer than it takes to overdue and then one cycle for each.
  constexpr std::uint32_t kPairs = 8;
  std::vector<PairUrgency> pairs;
  for (std::uint32_t k = 0; k < kPairs; ++k) pairs.push_back({0.1 * k, 0.0, 0});
  std::vector<std::uint32_t> turns(kPairs, 0);
  for (std::uint32_t cycle = 0; cycle < 200; ++cycle) {
    const auto first = std::min_element(pairs.begin(), pairs.end(), isMoreUrgent);
    ++turns[static_cast<std::size_t>(first - pairs.begin())];
    for (PairUrgency& pair : pairs) {
      ++pair.cycles_waited;
      EXPECT_LE(pair.cycles_waited, kLongestWait + kPairs);
    }
    first->cycles_waited = 0;
  }
  for (const std::uint32_t count : turns) EXPECT_GE(count, 200 / (kLongestWait + kPairs));
}

TEST(SolvingOrder, IsAStrictWeakOrder) {
  RandomEngine engine(5);
  std::vector<PairUrgency> pairs;
  for (int k = 0; k < 60; ++k) {
    const auto one_of = [&] { return 0.1 * static_cast<double>(uniformIndex(engine, 4)); };
    pairs.push_back({k % 7 == 0 ? kNotComputed : one_of(), k % 5 == 0 ? kNotComputed : one_of() - 0.2,
                     static_cast<std::uint32_t>(uniformIndex(engine, 6)), false, false,
                     uniformIndex(engine, 2) == 0});
  }
  const auto same = [](const PairUrgency& l, const PairUrgency& r) {
    return !isMoreUrgent(l, r) && !isMoreUrgent(r, l);
  };
  for (const PairUrgency& a : pairs) {
    EXPECT_FALSE(isMoreUrgent(a, a));
    for (const PairUrgency& b : pairs) {
      for (const PairUrgency& c : pairs) {
        EXPECT_FALSE(isMoreUrgent(a, b) && isMoreUrgent(b, c) && !isMoreUrgent(a, c));
        EXPECT_FALSE(same(a, b) && same(b, c) && !same(a, c));
      }
    }
  }
}

}  // namespace
}  // namespace concave_distance::solving_order_test
