#include <gtest/gtest.h>

#include <algorithm>

#include "interference/interference_checks.h"
#include "support/mesh_variants.h"
#include "support/thesis_scenes.h"

namespace concave_distance::interference_test {
namespace {

using test::interferenceOf;
using test::translation;

/// Roundings of a few coordinates of about a metre.
constexpr double kRounding = 1e-14;

double apart(const Eigen::Vector3d& l, const Eigen::Vector3d& r) {
  return (l - r).norm();
}

TEST(Interference, OfTwoBoxesIsABoxWithItsDepthAndAreas) {
  const SurfaceMesh a = test::makeCuboid({0, 0, 0}, {1, 1, 1});
  const SurfaceMesh b = test::makeCuboid({0.75, 0.25, 0.125}, {1.75, 0.75, 0.625});
  const Interference result = interferenceOf(a, b, Eigen::Isometry3d::Identity());
  ASSERT_EQ(result.regions.size(), 1u);
  const InterferenceRegion& region = result.regions[0];
  EXPECT_NEAR(region.depth_along_normal, 0.25, kRounding);
  EXPECT_NEAR(region.volume, 0.25 * 0.5 * 0.5, kRounding);
  EXPECT_NEAR(region.contact_area, 0.25, kRounding);
  EXPECT_NEAR(region.surface_area_a, 0.25, kRounding);
  EXPECT_NEAR(region.surface_area_b, 0.25 + 4 * 0.125, kRounding);
  EXPECT_NEAR(apart(region.normal_in_a, Eigen::Vector3d::UnitX()), 0.0, kRounding);
  EXPECT_NEAR(apart(region.centroid_in_a, {0.875, 0.5, 0.375}), 0.0, kRounding);
  EXPECT_NEAR(region.along_normal_a_in_a.x(), 1.0, kRounding);
  EXPECT_NEAR(region.along_normal_b_in_a.x(), 0.75, kRounding);
  EXPECT_EQ(region.loop_count, 1u);
  EXPECT_FALSE(region.touching || region.normal_is_fallback || !region.closed || !region.consistent);
}

TEST(Interference, OfABoxThatIsTippedIntoAnotherIsAPrism) {
  // An edge of B, at right angles to two of A's, `depth` below A's top; its faces rise at 45 degrees.
  const double depth = 0.125;
  const SurfaceMesh a = test::makeCuboid({-2, -2, -1}, {2, 2, 0});
  const SurfaceMesh b = test::makeCuboid({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  Eigen::Isometry3d pose(Eigen::AngleAxisd(M_PI / 4, Eigen::Vector3d::UnitX()));
  pose.translation().z() = std::sqrt(0.5) - depth;
  const Interference result = interferenceOf(a, b, pose);
  ASSERT_EQ(result.regions.size(), 1u);
  const InterferenceRegion& region = result.regions[0];
  EXPECT_NEAR(region.depth_along_normal, depth, kRounding);
  EXPECT_NEAR(region.volume, depth * depth, kRounding);
  EXPECT_NEAR(region.contact_area, 2.0 * depth, kRounding);
  EXPECT_NEAR(region.surface_area_a, 2.0 * depth, kRounding);
  EXPECT_NEAR(region.surface_area_b, 2.0 * std::sqrt(2.0) * depth + 2.0 * depth * depth, kRounding);
  EXPECT_NEAR(apart(region.normal_in_a, Eigen::Vector3d::UnitZ()), 0.0, kRounding);
  EXPECT_NEAR(apart(region.centroid_in_a, {0, 0, -depth / 3}), 0.0, kRounding);
}

TEST(Interference, OfFlushBoxesSharesTheFlushFaces) {
  const SurfaceMesh a = test::makeCuboid({0, 0, 0}, {1, 1, 1});
  const Interference result = interferenceOf(a, a, translation({0.5, 0, 0}));
  ASSERT_EQ(result.regions.size(), 1u);
  const InterferenceRegion& region = result.regions[0];
  EXPECT_NEAR(region.depth_along_normal, 0.5, kRounding);
  EXPECT_NEAR(region.volume, 0.5, kRounding);
  EXPECT_NEAR(region.contact_area, 1.0, kRounding);
  EXPECT_NEAR(region.surface_area_a, 2.0, kRounding);
  EXPECT_NEAR(region.surface_area_b, 2.0, kRounding);
  EXPECT_NEAR(apart(region.normal_in_a, Eigen::Vector3d::UnitX()), 0.0, kRounding);
}

TEST(Interference, OfABoxWithItselfIsTheBox) {
  const SurfaceMesh a = test::makeCuboid({0, 0, 0}, {1, 2, 3});
  const Interference result = interferenceOf(a, a, Eigen::Isometry3d::Identity());
  ASSERT_EQ(result.regions.size(), 1u);
  EXPECT_NEAR(result.regions[0].volume, 6.0, 6.0 * kRounding);
  EXPECT_NEAR(result.regions[0].depth_along_normal, 1.0, kRounding);
  EXPECT_TRUE(result.regions[0].normal_is_fallback);
}

TEST(Interference, OfBoxesThatTouchHasTheirCommonFace) {
  const SurfaceMesh a = test::makeCuboid({0, 0, 0}, {1, 1, 1});
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sense : {1.0, -1.0}) {
      Eigen::Vector3d shift = Eigen::Vector3d::Constant(0.25);
      shift[axis] = sense;
      const Interference result = interferenceOf(a, a, translation(shift));
      ASSERT_EQ(result.regions.size(), 1u) << shift.transpose();
      const InterferenceRegion& region = result.regions[0];
      EXPECT_TRUE(region.touching);
      EXPECT_EQ(region.depth_along_normal, 0.0);
      EXPECT_EQ(region.volume, 0.0);
      EXPECT_NEAR(region.contact_area, 0.75 * 0.75, kRounding);
      EXPECT_NEAR(apart(region.normal_in_a, sense * Eigen::Vector3d::Unit(axis)), 0.0, kRounding);
    }
  }
}

TEST(Interference, OfBoxesThatShareAnEdgeOrACornerIsNothingOrTouches) {
  const SurfaceMesh a = test::makeCuboid({0, 0, 0}, {1, 1, 1});
  for (const Eigen::Vector3d& shift :
       {Eigen::Vector3d(1, 1, 0), Eigen::Vector3d(1, 1, 0.5), Eigen::Vector3d(-1, 1, 0.25),
        Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(-1, -1, -1), Eigen::Vector3d(1, -1, 1)}) {
    for (const InterferenceRegion& region : interferenceOf(a, a, translation(shift)).regions) {
      EXPECT_TRUE(region.touching) << shift.transpose();
      EXPECT_EQ(region.contact_area, 0.0);
    }
  }
}

TEST(Interference, OfATippedBoxOnItsEdgeOrCornerTouches) {
  const SurfaceMesh a = test::makeCuboid({-2, -2, -1}, {2, 2, 0});
  // A corner at the origin of its frame, pointing down; coordinates exact.
  const SurfaceMesh b = test::makeSurface({{0, 0, 0}, {0.5, 0, 1}, {-0.5, 0.5, 1}, {-0.5, -0.5, 1}},
                                          {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}});
  const Interference result = interferenceOf(a, b, Eigen::Isometry3d::Identity());
  ASSERT_EQ(result.regions.size(), 1u);
  EXPECT_TRUE(result.regions[0].touching);
  EXPECT_EQ(result.regions[0].contact_area, 0.0);
  EXPECT_NEAR(apart(result.regions[0].centroid_in_a, Eigen::Vector3d::Zero()), 0.0, kRounding);
}

TEST(Interference, OfBodiesApartIsNone) {
  const SurfaceMesh a = test::makeCuboid({0, 0, 0}, {1, 1, 1});
  EXPECT_TRUE(interferenceOf(a, a, translation({1.0 + 1e-15, 0, 0})).regions.empty());
  EXPECT_TRUE(interferenceOf(a, a, translation({100, 0, 0})).regions.empty());
}

TEST(Interference, OfASphereOnAPlateIsACapWithinItsTessellation) {
  const double radius = 0.5;
  const double chord = 1e-4;
  const double depth = 0.02;
  const SurfaceMesh plate = test::makeCuboid({-1, -1, -1}, {1, 1, 0});
  const SurfaceMesh ball = makeSphere(radius, chord);
  const Interference result = interferenceOf(plate, ball, translation({0.1, 0.2, radius - depth}));
  ASSERT_EQ(result.regions.size(), 1u);
  const InterferenceRegion& region = result.regions[0];
  const double cap_area = M_PI * (2.0 * radius * depth - depth * depth);
  EXPECT_LE(region.depth_along_normal, depth + kRounding);
  EXPECT_GE(region.depth_along_normal, depth - chord);
  // The rim moves by at most the chord error over the slope of the ball there.
  const double rim = 2.0 * M_PI * std::sqrt(cap_area / M_PI) * chord * radius / std::sqrt(cap_area / M_PI);
  EXPECT_NEAR(region.contact_area, cap_area, rim);
  EXPECT_NEAR(region.volume, M_PI * depth * depth * (radius - depth / 3.0), chord * 1.1 * cap_area);
  EXPECT_NEAR(apart(region.normal_in_a, Eigen::Vector3d::UnitZ()), 0.0, 1e-12);
}

TEST(Interference, OfTwoSpheresIsALensWithinTheirTessellation) {
  const double chord = 1e-3;
  const SurfaceMesh ball = makeSphere(1.0, chord);
  const double distance = 1.5;
  const Eigen::Vector3d direction = Eigen::Vector3d(1, 2, -1).normalized();
  const Interference result = interferenceOf(ball, ball, translation(distance * direction));
  ASSERT_EQ(result.regions.size(), 1u);
  const InterferenceRegion& region = result.regions[0];
  EXPECT_NEAR(region.depth_along_normal, 2.0 - distance, 2.0 * chord);
  const double height = 1.0 - 0.5 * distance;
  const double lens = 2.0 * M_PI * height * height * (3.0 - height) / 3.0;
  const double cap = 2.0 * M_PI * height;
  EXPECT_LE(region.volume, lens);
  EXPECT_GE(region.volume, lens - 2.0 * chord * cap);
  EXPECT_NEAR(apart(region.normal_in_a, direction), 0.0, 0.05);
  EXPECT_NEAR(apart(region.centroid_in_a, 0.5 * distance * direction), 0.0, 0.01);
}

TEST(Interference, OfACylinderLyingOnAPlateIsASegmentOfItsPrism) {
  const double chord = 1e-5;
  const double depth = 0.01;
  const SurfaceMesh plate = test::makeCuboid({-1, -1, -1}, {1, 1, 0});
  const SurfaceMesh cylinder = makeCylinder(0.25, 0.8, chord);
  Eigen::Isometry3d pose(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitX()));
  pose.translation().z() = 0.25 - depth;
  const Interference result = interferenceOf(plate, cylinder, pose);
  ASSERT_EQ(result.regions.size(), 1u);
  const InterferenceRegion& region = result.regions[0];
  EXPECT_NEAR(region.depth_along_normal, depth, chord);
  const double angle = std::acos(1.0 - depth / 0.25);
  const double segment = 0.25 * 0.25 * (angle - std::sin(angle) * std::cos(angle));
  EXPECT_NEAR(region.volume, 0.8 * segment, 0.8 * chord * 2.0 * 0.25 * angle);
  EXPECT_NEAR(region.contact_area, 0.8 * 2.0 * 0.25 * std::sin(angle), 0.8 * 2.0 * chord / std::sin(angle));
}

TEST(Interference, OfASwallowedBodyIsTheBodyAndSaysSo) {
  const SurfaceMesh a = test::makeCuboid({0, 0, 0}, {4, 4, 4});
  const SurfaceMesh b = test::makeCuboid({0, 0, 0}, {1, 0.5, 0.5});
  const Interference result = interferenceOf(a, b, translation({2.75, 1.5, 1.5}));
  EXPECT_TRUE(result.b_inside_a);
  EXPECT_FALSE(result.a_inside_b);
  ASSERT_EQ(result.regions.size(), 1u);
  const InterferenceRegion& region = result.regions[0];
  EXPECT_TRUE(region.b_swallowed && region.normal_is_fallback);
  EXPECT_EQ(region.loop_count, 0u);
  EXPECT_NEAR(region.volume, 0.25, kRounding);
  EXPECT_NEAR(region.depth_along_normal, 1.25, 8 * kRounding);
  EXPECT_NEAR(apart(region.normal_in_a, Eigen::Vector3d::UnitX()), 0.0, kRounding);
  EXPECT_NEAR(apart(region.centroid_in_a, {3.25, 1.75, 1.75}), 0.0, 4 * kRounding);
  const Interference swapped = interferenceOf(b, a, translation({-2.75, -1.5, -1.5}));
  EXPECT_TRUE(swapped.a_inside_b);
  ASSERT_EQ(swapped.regions.size(), 1u);
  EXPECT_TRUE(swapped.regions[0].a_swallowed);
  EXPECT_NEAR(swapped.regions[0].depth_along_normal, 1.25, 8 * kRounding);
}

TEST(Interference, InACavityIsNoneAndTakesTheCavityOffWhatIsAroundIt) {
  const SurfaceMesh hollow = test::makeJoined(test::makeCuboid({0, 0, 0}, {3, 3, 3}),
                                              test::makeTurned(test::makeCuboid({1, 1, 1}, {2, 2, 2})));
  const SurfaceMesh small = test::makeCuboid({0, 0, 0}, {0.5, 0.5, 0.5});
  EXPECT_TRUE(interferenceOf(hollow, small, translation({1.25, 1.25, 1.25})).regions.empty());
  const SurfaceMesh large = test::makeCuboid({-0.5, -0.5, -0.5}, {2.5, 3.5, 3.5});
  const Interference result = interferenceOf(hollow, large, Eigen::Isometry3d::Identity());
  ASSERT_EQ(result.regions.size(), 1u);
  EXPECT_NEAR(result.regions[0].volume, 2.5 * 9.0 - 1.0, 30 * kRounding);
  EXPECT_NEAR(result.regions[0].surface_area_a, 4 * 7.5 + 9.0 + 6.0, 50 * kRounding);
  EXPECT_TRUE(result.regions[0].consistent);
}

TEST(Interference, OfAPegThroughAPlateIsOneRegionWithTwoLoops) {
  const SurfaceMesh plate = test::makeCuboid({-2, -2, -0.25}, {2, 2, 0.25});
  const SurfaceMesh peg = test::makeCuboid({-0.125, -0.5, -3}, {0.125, 0.5, 3});
  const Interference result = interferenceOf(plate, peg, translation({0.3, 0.2, 0.1}));
  ASSERT_EQ(result.regions.size(), 1u);
  const InterferenceRegion& region = result.regions[0];
  EXPECT_EQ(region.loop_count, 2u);
  EXPECT_TRUE(region.normal_is_fallback);
  EXPECT_NEAR(region.contact_area, 0.0, kRounding);
  EXPECT_NEAR(region.surface_area_a, 0.5, kRounding);
  EXPECT_NEAR(region.volume, 0.125, kRounding);
  EXPECT_NEAR(region.depth_along_normal, 0.25,
              kRounding);  // across the peg's thickness, less than the plate's
  EXPECT_NEAR(std::abs(region.normal_in_a.x()), 1.0, kRounding);
}

TEST(Interference, AFallbackNormalKeepsAKnownOneAmongThoseOfLeastDepth) {
  const auto plate = test::makeBody(test::makeCuboid({-2, -2, -0.25}, {2, 2, 0.25}));
  const auto peg = test::makeBody(test::makeCuboid({-0.125, -0.5, -3}, {0.125, 0.5, 3}));
  InterferenceWorkspace workspace;
  Interference result;
  const auto normal = [&](const std::vector<KnownNormal>& known) {
    findInterference(*plate, *peg, translation({0.3, 0.2, 0.1}), workspace, result, nullptr, known);
    return result.regions.at(0).normal_in_a;
  };
  const Eigen::Vector3d centroid(0.3, 0.2, 0.0);
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  EXPECT_NEAR(apart(normal({}), x), 0.0, kRounding);
  EXPECT_NEAR(apart(normal({{centroid, 0.1, -x}}), -x), 0.0, kRounding);
  EXPECT_NEAR(apart(normal({{centroid + x, 2.0, x}, {centroid, 0.1, -x}}), -x), 0.0, kRounding) << "nearest";
  EXPECT_NEAR(apart(normal({{centroid + x, 0.5, -x}}), x), 0.0, kRounding) << "of another region";
  // A little aside: 0.25 / cos, within 1 %. Along z it is twice as deep.
  const Eigen::Vector3d aside = Eigen::Vector3d(-1.0, 0.0, 0.1).normalized();
  EXPECT_NEAR(apart(normal({{centroid, 0.1, aside}}), aside), 0.0, kRounding);
  EXPECT_NEAR(std::abs(normal({{centroid, 0.1, Eigen::Vector3d::UnitZ()}}).x()), 1.0, kRounding);
}

TEST(Interference, OfATubeThroughAPlateIsOneRegionAlsoWhereItsEndsAreInOneTriangle) {
  const SurfaceMesh plate = test::makeCuboid({-3, -3, -0.25}, {3, 3, 0.25});
  const SurfaceMesh tube = test::makeRingThrough(12, 4, [](std::uint32_t i, std::uint32_t j) {
    const double r = j == 0 || j == 1 ? 0.5 : 0.25;
    const double angle = 2.0 * M_PI * i / 12;
    return Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), j == 1 || j == 2 ? 1.0 : -1.0);
  });
  const Interference result = interferenceOf(plate, tube, translation({1.5, 0.2, 0.0}));
  ASSERT_EQ(result.regions.size(), 1u);
  EXPECT_EQ(result.regions[0].loop_count, 4u);
  const double ring = 6.0 * std::sin(M_PI / 6.0) * (0.25 - 0.0625);
  EXPECT_NEAR(result.regions[0].volume, 0.5 * ring, 4 * kRounding);
}

TEST(Interference, OfACombAndABarHasARegionForEveryTooth) {
  const SurfaceMesh comb = test::makeComb(5);
  const SurfaceMesh bar = test::makeCuboid({-1, 0.375, -1}, {3, 0.5, 1});
  const Interference result = interferenceOf(comb, bar, Eigen::Isometry3d::Identity());
  ASSERT_EQ(result.regions.size(), 5u);
  for (const InterferenceRegion& region : result.regions) {
    EXPECT_NEAR(region.depth_along_normal, 0.025, kRounding);
    EXPECT_NEAR(region.volume, 0.1 * 0.025 * 0.2, kRounding);
    EXPECT_NEAR(apart(region.normal_in_a, Eigen::Vector3d::UnitY()), 0.0, kRounding);
  }
}

TEST(Interference,
     OfTheBatteryPushedIntoItsFixtureHasSeveralRegionsThatTheTranslationAlongTheirNormalsUndoes) {
  const auto fixture = test::loadThesisBody("fixture", 10.0);
  const auto battery = test::loadThesisBody("battery", 10.0);
  Eigen::Isometry3d pose = test::readThesisPoses("battery_static.csv").front();
  std::size_t most = 0;
  for (int step = 0; step < 60; ++step) {
    pose.translation().z() -= 0.01 * battery->diameter();
    const Interference result = interferenceOf(*fixture, *battery, pose);
    most = std::max(most, result.regions.size());
    for (const InterferenceRegion& region : result.regions) {
      EXPECT_TRUE(region.closed && region.consistent);
      EXPECT_GE(region.depth_along_normal, 0.0);
      EXPECT_NEAR((region.along_normal_a_in_a - region.along_normal_b_in_a -
                   region.depth_along_normal * region.normal_in_a)
                      .norm(),
                  0.0, 4.0 * result.rounding_bound);
    }
  }
  EXPECT_GE(most, 2u);
}

TEST(Interference, OfOpenSheetsIsTheirCurvesFlagged) {
  const SurfaceMesh box = test::makeCuboid({0, 0, 0}, {1, 1, 1});
  const SurfaceMesh sheet = test::makeSheet(4, 4, 0.5);
  const Interference across = interferenceOf(box, sheet, translation({-0.55, -0.35, 0.75}));
  ASSERT_EQ(across.regions.size(), 1u);
  EXPECT_FALSE(across.regions[0].closed);
  EXPECT_EQ(across.regions[0].loop_count, 1u);
  EXPECT_TRUE(std::isnan(across.regions[0].volume) && std::isnan(across.regions[0].contact_area));
  EXPECT_NEAR(std::abs(across.regions[0].normal_in_a.z()), 1.0, kRounding);
  EXPECT_NEAR(apart(across.regions[0].centroid_in_a, {0.5, 0.5, 0.75}), 0.0, kRounding);
  Eigen::Isometry3d upright(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d(1, 0.1, 0).normalized()));
  upright.translation() = Eigen::Vector3d(0.3, 1.1, -1.2);
  const Interference sheets = interferenceOf(sheet, sheet, upright);
  ASSERT_EQ(sheets.regions.size(), 1u);
  EXPECT_EQ(sheets.regions[0].loop_count, 0u);
  EXPECT_NEAR(sheets.regions[0].normal_in_a.norm(), 1.0, kRounding);
  const Interference swallowed =
      interferenceOf(box, test::makeSheet(2, 2, 0.1), translation({0.3, 0.3, 0.5}));
  ASSERT_EQ(swallowed.regions.size(), 1u);
  EXPECT_TRUE(swallowed.b_inside_a && !swallowed.regions[0].closed);
  EXPECT_NEAR(swallowed.regions[0].surface_area_b, 0.04, kRounding);
}

// The box and the sheet have an edge and its corners in common.
TEST(Interference, OfABoxWithASheetOnItsEdgeIsThatOfTheBoxAndTheSheetsCurves) {
  const SurfaceMesh box = test::makeCuboid({0, 0, 0}, {1, 1, 1});
  std::vector<Eigen::Vector3d> vertices = box.vertices();
  std::vector<TriangleNodes> triangles = box.triangles();
  const auto corner = [&](const Eigen::Vector3d& at) {
    return NodeIndex{
        static_cast<std::size_t>(std::find(vertices.begin(), vertices.end(), at) - vertices.begin())};
  };
  triangles.push_back(
      {corner(Eigen::Vector3d(0, 0, 1)), corner(Eigen::Vector3d(1, 0, 1)), NodeIndex{vertices.size()}});
  vertices.emplace_back(0.5, 0, 2);
  const SurfaceMesh finned(vertices, triangles, "finned box");

  const SurfaceMesh bar = test::makeCuboid({0.25, -0.5, 0.5}, {0.75, 0.5, 3});
  for (const bool swapped : {false, true}) {
    const Interference cut = swapped ? interferenceOf(bar, finned, Eigen::Isometry3d::Identity())
                                     : interferenceOf(finned, bar, Eigen::Isometry3d::Identity());
    ASSERT_GE(cut.regions.size(), 2u);
    std::size_t solids = 0;
    for (const InterferenceRegion& region : cut.regions) {
      EXPECT_TRUE(region.consistent);
      solids += region.closed ? 1U : 0U;
      if (!region.closed) continue;
      EXPECT_NEAR(region.volume, 0.125, kRounding);
      EXPECT_EQ(region.loop_count, 1u);
    }
    EXPECT_EQ(solids, 1u);
  }

  const SurfaceMesh room = test::makeCuboid({-1, -1, -1}, {3, 3, 3});
  const Interference swallowed = interferenceOf(finned, room, Eigen::Isometry3d::Identity());
  ASSERT_EQ(swallowed.regions.size(), 2u);
  for (const InterferenceRegion& region : swallowed.regions) {
    EXPECT_TRUE(region.a_swallowed);
    EXPECT_NEAR(region.surface_area_a, region.closed ? 6.0 : 0.5, 8 * kRounding);
    EXPECT_NEAR(region.closed ? region.volume : 1.0, 1.0, kRounding);
  }
}

TEST(Interference, RefusesWhatIsNoPose) {
  const SurfaceMesh box = test::makeCuboid({0, 0, 0}, {1, 1, 1});
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(interferenceOf(box, box, pose).status, InterferenceStatus::InvalidPose);
  pose = Eigen::Isometry3d::Identity();
  pose.linear() *= 1.1;
  EXPECT_EQ(interferenceOf(box, box, pose).status, InterferenceStatus::InvalidPose);
}

}  // namespace
}  // namespace concave_distance::interference_test
