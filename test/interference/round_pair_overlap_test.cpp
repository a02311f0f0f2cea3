// Regions of overlap of two exact round solids, and of a pair taken either way round.
#include <gtest/gtest.h>

#include <vector>

#include "base/constants.h"
#include "support/concave_shapes.h"
#include "support/round_bodies.h"

namespace concave_distance::round_pair_overlap_test {
namespace {

using Body = std::shared_ptr<const BodyMesh>;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using test::block;
using test::makeBody;
using test::makeRoundBody;
using test::overlapOf;
using test::roundShape;
using test::sumOf;
using test::translation;

TEST(RoundOverlap, TwoBallsAreALens) {
  const double r = 0.5;
  const double q = 0.3;
  for (const double depth : {1e-4, 0.01, 0.1}) {
    const double d = r + q - depth;
    for (const bool swapped : {false, true}) {
      const Body a = makeRoundBody(test::sphereOf(swapped ? q : r));
      const Body b = makeRoundBody(test::sphereOf(swapped ? r : q));
      const Interference found = overlapOf(a, b, translation(d * Vector3d(0.6, 0.0, 0.8)));
      ASSERT_EQ(found.regions.size(), 1U);
      const double volume =
          kPi * depth * depth * (d * d + 2.0 * d * (r + q) - 3.0 * (r - q) * (r - q)) / (12.0 * d);
      EXPECT_NEAR(found.regions[0].volume, volume, 1e-5 * volume);
      EXPECT_NEAR(found.regions[0].depth, depth, 1e-12);
      EXPECT_NEAR((found.regions[0].normal_in_a - Vector3d(0.6, 0.0, 0.8)).norm(), 0.0, 1e-6);
      // The rim is where both spheres cross.
      const double x = (d * d + r * r - q * q) / (2.0 * d);
      EXPECT_NEAR(found.regions[0].contact_area, kPi * (r * r - x * x), 1e-4 * (r * r - x * x));
    }
  }
}

TEST(RoundOverlap, ABallOnACylindersCapIsABallOnAPlane) {
  const Body ball = makeRoundBody(test::sphereOf(0.2));
  const Body disc = makeRoundBody(roundShape(RoundKind::Cylinder, 1.0, 0.1));
  for (const double depth : {1e-4, 0.01}) {
    const Interference found = overlapOf(disc, ball, translation({0.1, 0.2, 0.3 - depth}));
    const Interference plane = overlapOf(block(), ball, translation({0.1, 0.2, 0.2 - depth}));
    ASSERT_EQ(found.regions.size(), 1U);
    ASSERT_EQ(plane.regions.size(), 1U);
    EXPECT_NEAR(found.regions[0].volume, plane.regions[0].volume, 1e-4 * plane.regions[0].volume);
    // Over the ball's surface: 2 pi r dz of it at each depth z.
    const double sum = kPi * 0.2 * depth * depth;
    EXPECT_NEAR(sumOf(found, found.regions[0], 1), sum, 1e-5 * sum);
  }
}

TEST(RoundOverlap, SolidsWithinOrThroughEachOtherAreTakenAsMeshes) {
  const Body large = makeRoundBody(test::sphereOf(0.5));
  const Body small = makeRoundBody(test::sphereOf(0.1));
  const Interference held = overlapOf(large, small, translation({0.1, 0.0, 0.0}));
  ASSERT_EQ(held.regions.size(), 1U);
  EXPECT_TRUE(held.b_inside_a);
  const Body rod = makeRoundBody(roundShape(RoundKind::Capsule, 0.05, 2.0));
  EXPECT_EQ(overlapOf(large, rod, translation({0.1, 0.0, 0.0})).regions.size(), 1U);
  EXPECT_TRUE(overlapOf(large, small, translation({0.61, 0.0, 0.0})).regions.empty());
}

TEST(RoundOverlap, SwappedBodiesMirrorTheRegions) {
  RandomEngine engine(13);
  const std::vector<RoundShape> shapes{test::sphereOf(0.2), roundShape(RoundKind::Capsule, 0.1, 0.2),
                                       roundShape(RoundKind::Cylinder, 0.15, 0.1)};
  int compared = 0;
  for (std::uint32_t i = 0; i < 60; ++i) {
    RoundShape placed = shapes[i % 3];
    placed.body_from_shape = test::randomPose(engine, 0.2);
    const Body round = makeRoundBody(placed);
    const Body mesh = i % 5 == 0 ? makeRoundBody(shapes[(i + 1) % 3]) : makeBody(test::concaveShape(i / 3));
    const Isometry3d pose = test::randomPose(engine, 0.4);
    const Interference found = overlapOf(mesh, round, pose);
    const Interference swapped = overlapOf(round, mesh, pose.inverse(Eigen::Isometry));
    ASSERT_EQ(found.regions.size(), swapped.regions.size()) << i;
    EXPECT_EQ(found.a_inside_b, swapped.b_inside_a);
    for (std::size_t r = 0; r < found.regions.size(); ++r) {
      const InterferenceRegion& there = found.regions[r];
      const InterferenceRegion& back = swapped.regions[r];
      if (!there.closed) continue;
      ++compared;
      EXPECT_NEAR(there.volume, back.volume, 1e-3 * there.volume + 1e-12) << i;
      EXPECT_NEAR(there.depth, back.depth, 1e-2 * there.depth) << i;
      EXPECT_NEAR(there.surface_area_a, back.surface_area_b, 1e-2 * there.surface_area_a + 1e-12) << i;
      EXPECT_NEAR((pose * back.centroid_in_a - there.centroid_in_a).norm(), 0.0, 1e-3) << i;
      if (there.normal_is_fallback) continue;
      EXPECT_NEAR((pose.linear() * back.normal_in_a + there.normal_in_a).norm(), 0.0, 1e-3) << i;
    }
  }
  EXPECT_GT(compared, 15);
}

}  // namespace
}  // namespace concave_distance::round_pair_overlap_test
