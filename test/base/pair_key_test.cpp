#include "base/pair_key.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <set>
#include <vector>

#include "base/pair_table.h"

namespace concave_distance::pair_key_test {
namespace {

TEST(PairKey, DiffersForEveryPairAndForTheSwappedOne) {
  const std::vector<std::uint32_t> values = {0, 1, 2, 0x7fffffffU, 0xfffffffeU, 0xffffffffU};
  std::set<std::uint64_t> keys;
  for (const std::uint32_t a : values) {
    for (const std::uint32_t b : values) keys.insert(pairKey(TriangleIndex{a}, TriangleIndex{b}));
  }
  EXPECT_EQ(keys.size(), values.size() * values.size());
}

// Neighbouring triangles are asked for together: a grid of pairs, the table a quarter full.
TEST(PairKey, NeighbouringPairsSpreadOverTheTable) {
  constexpr std::uint32_t kBits = 12;
  std::vector<int> in_slot(std::size_t{1} << kBits, 0);
  for (std::uint32_t a = 5000; a < 5032; ++a) {
    for (std::uint32_t b = 70000; b < 70032; ++b) {
      const std::size_t slot = slotOfKey(pairKey(TriangleIndex{a}, TriangleIndex{b}), 64 - kBits);
      ASSERT_LT(slot, in_slot.size());
      ++in_slot[slot];
    }
  }
  // Random places would have 1024 balls in 4096 urns: more than 5 in one happens once in about 1000 tables.
  EXPECT_LE(*std::max_element(in_slot.begin(), in_slot.end()), 5);
}

TEST(PairTable, KeepsTheFirstNumberOfEachPairUntilItIsCleared) {
  PairTable table(1);
  for (std::uint32_t round = 0; round < 3; ++round) {
    for (std::uint32_t i = 0; i < 100; ++i) {
      EXPECT_EQ(table.insert(NodeIndex{i}, NodeIndex{i + 1}, i + round), i + round);
      EXPECT_EQ(table.insert(NodeIndex{i}, NodeIndex{i + 1}, 1000), i + round);
    }
    EXPECT_EQ(table.size(), 100U);
    EXPECT_EQ(table.find(NodeIndex{8}, NodeIndex{7}), PairTable::kAbsent);
    table.clear();
    EXPECT_EQ(table.find(NodeIndex{7}, NodeIndex{8}), PairTable::kAbsent);
  }
}

}  // namespace
}  // namespace concave_distance::pair_key_test
