#include "tracking/ripple_memory.h"

#include <gtest/gtest.h>

namespace concave_distance {
namespace {

TEST(RippleMemory, KeepsAVerdictForItsCycleAndOfThatTrianglePairAlone) {
  RippleMemory ripples;
  const TriangleIndex a{3};
  const TriangleIndex b{7};
  EXPECT_FALSE(ripples.ownerOf(a, b, 0));
  ripples.remember(a, b, 42, 10);
  EXPECT_EQ(ripples.ownerOf(a, b, 10), 42U);
  EXPECT_FALSE(ripples.ownerOf(a, b, 11));
  EXPECT_FALSE(ripples.ownerOf(b, a, 10));
  ripples.clear();
  EXPECT_FALSE(ripples.ownerOf(a, b, 10));
}

TEST(RippleMemory, HoldsMostOfAHundredRipplesAtOnce) {
  RippleMemory ripples;
  for (std::uint32_t k = 0; k < 100; ++k) ripples.remember(TriangleIndex{k}, TriangleIndex{5 * k}, k + 1, 0);
  int held = 0;
  for (std::uint32_t k = 0; k < 100; ++k) {
    held += ripples.ownerOf(TriangleIndex{k}, TriangleIndex{5 * k}, 0) == std::uint64_t{k} + 1 ? 1 : 0;
  }
  EXPECT_GT(held, 80);
}

}  // namespace
}  // namespace concave_distance
