#include "base/random_engine.h"

#include <gtest/gtest.h>

#include <array>

namespace concave_distance::random_engine_test {
namespace {

TEST(RandomEngine, GivesTheSameStreamOnEveryPlatform) {
  // xoshiro256** seeded by splitmix64 from 0; the four state words are the published splitmix64 outputs.
  RandomEngine engine(0);
  RandomEngine again(0);
  for (int i = 0; i < 1000; ++i) {
    EXPECT_EQ(engine(), again());
  }
  EXPECT_EQ(RandomEngine(0)(), 11091344671253066420ULL);
}

TEST(RandomEngine, UniformIndexIsUniform) {
  RandomEngine engine(7);
  std::array<int, 6> counts{};
  constexpr int kDraws = 600000;
  for (int i = 0; i < kDraws; ++i) {
    ++counts.at(uniformIndex(engine, 6));
  }
  double chi_squared = 0.0;
  for (const int count : counts) {
    const double expected = kDraws / 6.0;
    chi_squared += (count - expected) * (count - expected) / expected;
  }
  EXPECT_LT(chi_squared, 25.7);  // 5 degrees of freedom, p = 1e-4
}

TEST(RandomEngine, UniformUnitStaysInItsInterval) {
  RandomEngine engine(3);
  double sum = 0.0;
  for (int i = 0; i < 100000; ++i) {
    const double u = uniformUnit(engine);
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u;
  }
  EXPECT_NEAR(sum / 100000, 0.5, 0.005);  // five standard errors
}

TEST(StreamSeed, DependsOnEachOfItsKeys) {
  const std::uint64_t base = streamSeed(1, "a/b", 0);
  EXPECT_EQ(base, streamSeed(1, "a/b", 0));
  EXPECT_NE(base, streamSeed(2, "a/b", 0));
  EXPECT_NE(base, streamSeed(1, "b/a", 0));
  EXPECT_NE(base, streamSeed(1, "a/b", 1));
}

}  // namespace
}  // namespace concave_distance::random_engine_test
