#include <gtest/gtest.h>

#include "interference/interference_checks.h"

namespace concave_distance {
namespace {

using test::interferenceOf;
using test::translation;

TEST(Interference, OfTwoBoxesIsABoxWithItsDepthAndAreas) {
  const auto a = test::makeBody(test::makeCuboid({0, 0, 0}, {1, 1, 1}));
  const auto b = test::makeBody(test::makeCuboid({0.75, 0.25, 0.125}, {1.75, 0.75, 0.625}));
  const Interference result = interferenceOf(*a, *b, Eigen::Isometry3d::Identity());
  ASSERT_EQ(result.regions.size(), 1u);
  const InterferenceRegion& region = result.regions[0];
  EXPECT_NEAR(region.depth, 0.25, 1e-14);
  EXPECT_NEAR(region.volume, 0.25 * 0.5 * 0.5, 1e-14);
  EXPECT_NEAR(region.contact_area, 0.25, 1e-14);
  EXPECT_NEAR(region.surface_area_a, 0.25, 1e-14);
  EXPECT_NEAR(region.surface_area_b, 0.25 + 4 * 0.125, 1e-14);
  EXPECT_NEAR((region.normal_in_a - Eigen::Vector3d::UnitX()).norm(), 0.0, 1e-14);
  EXPECT_NEAR((region.centroid_in_a - Eigen::Vector3d(0.875, 0.5, 0.375)).norm(), 0.0, 1e-14);
  EXPECT_NEAR(region.point_a_in_a.x(), 1.0, 1e-14);
  EXPECT_NEAR(region.point_b_in_a.x(), 0.75, 1e-14);
  EXPECT_EQ(region.loop_count, 1u);
  EXPECT_FALSE(region.touching || region.normal_is_fallback || !region.closed || !region.consistent);
}

TEST(Interference, OfFlushBoxesSharesTheFlushFaces) {
  const auto a = test::makeBody(test::makeCuboid({0, 0, 0}, {1, 1, 1}));
  const Interference result = interferenceOf(*a, *a, translation({0.5, 0, 0}));
  ASSERT_EQ(result.regions.size(), 1u);
  const InterferenceRegion& region = result.regions[0];
  EXPECT_NEAR(region.depth, 0.5, 1e-14);
  EXPECT_NEAR(region.volume, 0.5, 1e-14);
  EXPECT_NEAR(region.contact_area, 1.0, 1e-14);
  EXPECT_NEAR(region.surface_area_a, 2.0, 1e-14);
  EXPECT_NEAR(region.surface_area_b, 2.0, 1e-14);
  EXPECT_NEAR((region.normal_in_a - Eigen::Vector3d::UnitX()).norm(), 0.0, 1e-14);
}

TEST(Interference, OfBoxesThatTouchHasTheirCommonFace) {
  const auto a = test::makeBody(test::makeCuboid({0, 0, 0}, {1, 1, 1}));
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sense : {1.0, -1.0}) {
      Eigen::Vector3d shift = Eigen::Vector3d::Constant(0.25);
      shift[axis] = sense;
      const Interference result = interferenceOf(*a, *a, translation(shift));
      ASSERT_EQ(result.regions.size(), 1u) << shift.transpose();
      const InterferenceRegion& region = result.regions[0];
      EXPECT_TRUE(region.touching);
      EXPECT_EQ(region.depth, 0.0);
      EXPECT_NEAR(region.contact_area, 0.75 * 0.75, 1e-14);
      EXPECT_NEAR((region.normal_in_a - sense * Eigen::Vector3d::Unit(axis)).norm(), 0.0, 1e-14);
    }
  }
}

TEST(Interference, OfBodiesApartIsNone) {
  const auto a = test::makeBody(test::makeCuboid({0, 0, 0}, {1, 1, 1}));
  EXPECT_TRUE(interferenceOf(*a, *a, translation({1.001, 0, 0})).regions.empty());
  EXPECT_TRUE(interferenceOf(*a, *a, translation({100, 0, 0})).regions.empty());
}

}  // namespace
}  // namespace concave_distance
