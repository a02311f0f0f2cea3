#include "thesis/src/evaluation/enumeration.h"

#include <gtest/gtest.h>

#include "support/body_pairs.h"
#include "support/enumeration.h"

namespace concave_distance::thesis_enumeration_test {
namespace {

TEST(EnumerateNodePairsInParallel, FindsWhatTheOracleFinds) {
  RandomEngine engine(1);
  for (std::uint32_t round = 0; round < 12; ++round) {
    const auto a = test::makeBody(test::concaveShape(round), 0.2);
    const auto b = test::makeBody(test::concaveShape(round / 2), 0.25);
    const Eigen::Isometry3d pose = test::randomPose(engine, 1.0);
    const TrialPoint found = enumerateNodePairs(*a, *b, pose);
    const TrialPoint expected = test::enumerateNodePairs(*a, *b, pose);
    EXPECT_TRUE(samePlace(found, expected));
    EXPECT_EQ(found.squared_distance, expected.squared_distance);
  }
}

TEST(EnumerateNodePairsInParallel, GivesTiesToTheSmallerNodes) {
  // Two lattices with a great many equally close pairs, exactly representable.
  const auto a = test::makeBody(test::makeSheet(16, 16, 0.25));
  const Eigen::Isometry3d pose = test::translation(Eigen::Vector3d(0.0, 0.0, 1.0));
  for (int repeat = 0; repeat < 20; ++repeat) {
    const TrialPoint found = enumerateNodePairs(*a, *a, pose);
    EXPECT_EQ(found.squared_distance, 1.0);
    EXPECT_EQ(found.node_a, NodeIndex{0});
    EXPECT_EQ(found.node_b, NodeIndex{0});
  }
}

}  // namespace
}  // namespace concave_distance::thesis_enumeration_test
