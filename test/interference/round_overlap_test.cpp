// Regions of overlap of exact round solids: closed forms, Monte Carlo, fine meshes, and work on closed ways.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "concave_distance/interference/interference.h"
#include "mesh/surface/mesh_topology.h"
#include "mesh/surface/round_geometry.h"
#include "mesh/trees/triangle_tree.h"
#include "support/count_allocations.h"
#include "support/round_bodies.h"

namespace concave_distance::round_overlap_test {
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
using test::turned;

/// Of the triangles that pressure is drawn on: chords of the border, so a little less than the surface.
void expectFacetsCover(const Interference& found, const InterferenceRegion& region, bool of_b,
                       double surface) {
  double sum = 0.0;
  for (std::uint32_t f = 0; f < region.facet_count; ++f) {
    const OverlapFacet& facet = found.facets[region.first_facet + f];
    const auto& [p, q, r] = facet.corners_in_a;
    const Vector3d twice_area = (q - p).cross(r - p);
    EXPECT_GE(twice_area.dot(facet.normal_in_a), 0.0);
    EXPECT_EQ(facet.of_b, of_b);
    sum += 0.5 * twice_area.norm();
  }
  EXPECT_LE(sum, 1.0001 * surface);
  EXPECT_GE(sum, 0.985 * surface);
}

TEST(RoundOverlap, ABallInAPlaneIsACap) {
  const double r = 0.5;
  for (const double depth : {1e-5, 1e-3, 0.05, 0.3, 0.49, 0.6, 0.9}) {
    const Body ball = makeRoundBody(test::sphereOf(r));
    const Interference found = overlapOf(block(), ball, turned(0.7, {1, 2, 3}, {0.02, 0.01, r - depth}));
    ASSERT_EQ(found.regions.size(), 1U) << depth;
    const InterferenceRegion& region = found.regions[0];
    const double h = r - depth;
    const double rim = std::sqrt(r * r - h * h);
    const double tolerance = 1e-5;
    EXPECT_NEAR(region.surface_area_a, kPi * rim * rim, 1e-5 * rim * rim) << depth;
    EXPECT_NEAR(region.contact_area, kPi * rim * rim, 1e-5 * rim * rim) << depth;
    expectFacetsCover(found, region, false, kPi * rim * rim);
    const double volume = kPi * depth * depth * (3.0 * r - depth) / 3.0;
    EXPECT_NEAR(region.volume, volume, tolerance * volume) << depth;
    EXPECT_NEAR(region.surface_area_b, 2.0 * kPi * r * depth, 10.0 * tolerance * r * depth) << depth;
    EXPECT_NEAR(region.depth, depth, 1e-12) << depth;
    EXPECT_NEAR(region.depth_along_normal, depth, 1e-12) << depth;
    EXPECT_NEAR((region.normal_in_a - Vector3d::UnitZ()).norm(), 0.0, 1e-12);
    EXPECT_NEAR((region.point_b_in_a - Vector3d(0.02, 0.01, -depth)).norm(), 0.0, 1e-9) << depth;
    const double middle = -0.25 * depth * (4.0 * r - depth) / (3.0 * r - depth);
    EXPECT_NEAR(region.centroid_in_a.z(), middle, 10.0 * tolerance * depth) << depth;
    EXPECT_NEAR(region.centroid_in_a.x(), 0.02, tolerance * rim) << depth;
    const double core = std::abs(h);
    const double sum = 2.0 * kPi * (0.5 * r * rim * rim - (r * r * r - core * core * core) / 3.0);
    EXPECT_NEAR(sumOf(found, region, 1), sum, (depth < 0.4 ? 1e-5 : 1e-3) * sum) << depth;
  }
}

// The face is two triangles: where their common edge cuts the patch changes nothing, so a ball on it is not
// turned. On a ray the depth is quadratic but for a share of (rim/h)^2, which three points integrate up to
// the fifth power of the way: they leave 1/2800 of the sixth.
TEST(RoundOverlap, APatchIsTheSameWhereverAnEdgeCutsIt) {
  const double r = 0.1;
  for (const double depth : {1e-6, 1e-5, 1e-4}) {
    const double h = r - depth;
    const double rim = std::sqrt(depth * (r + h));
    const double sum = kPi * depth * depth * (r - 2.0 / 3.0 * depth);
    const double bound = 4e-4 * rim * rim / (h * h);
    for (const double shift : {0.0, 1e-12, 1e-8, 1e-5, 0.01, 0.1, 0.5, 0.9, 1.2, 1.4, 2.0}) {
      const Vector3d foot(-0.3 + shift * rim, -0.1, 0.0);  // beside the middle of the face
      const Body ball = makeRoundBody(test::sphereOf(r));
      const Interference found = overlapOf(block(), ball, turned(0.7, {1, 2, 3}, foot + Vector3d(0, 0, h)));
      ASSERT_EQ(found.regions.size(), 1U) << shift;
      Vector3d moment = Vector3d::Zero();
      for (const OverlapSample& sample : found.samples)
        moment += sample.area * sample.depth * (sample.point_in_a - foot);
      EXPECT_NEAR(sumOf(found, found.regions[0], 1), sum, bound * sum) << depth << " " << shift;
      EXPECT_LE(moment.head<2>().norm(), bound * sum * rim) << depth << " " << shift;
    }
  }
}

TEST(RoundOverlap, CylindersAndCapsulesOnAPlaneHaveClosedForms) {
  const double r = 0.3;
  const double h = 0.5;
  const double depth = 0.02;
  const double segment =
      r * r * std::acos((r - depth) / r) - (r - depth) * std::sqrt(2.0 * r * depth - depth * depth);
  const double cap = kPi * depth * depth * (3.0 * r - depth) / 3.0;
  const Isometry3d lying = turned(0.5 * kPi, {1.0, 0.0, 0.0}, {0.1, 0.03, r - depth});
  const Isometry3d standing = turned(0.4, {0.0, 0.0, 1.0}, {0.1, 0.03, h - depth});
  for (const RoundKind kind : {RoundKind::Capsule, RoundKind::Cylinder}) {
    const Body round = makeRoundBody(roundShape(kind, r, h));
    const Interference found = overlapOf(block(), round, lying);
    ASSERT_EQ(found.regions.size(), 1U);
    const double volume = 2.0 * h * segment + (kind == RoundKind::Capsule ? cap : 0.0);
    EXPECT_NEAR(found.regions[0].volume, volume, 2e-5 * volume);
    EXPECT_NEAR(found.regions[0].depth, depth, 1e-12);
    const double width = 2.0 * std::sqrt(2.0 * r * depth - depth * depth);
    const double area = 2.0 * h * width + (kind == RoundKind::Capsule ? 0.25 * kPi * width * width : 0.0);
    EXPECT_NEAR(found.regions[0].surface_area_a, area, 3e-4 * area);
    expectFacetsCover(found, found.regions[0], false, area);
  }
  const Interference found =
      overlapOf(makeRoundBody(roundShape(RoundKind::Cylinder, r, h)), block(), standing.inverse());
  ASSERT_EQ(found.regions.size(), 1U);
  EXPECT_NEAR(found.regions[0].volume, kPi * r * r * depth, 1e-7);
  EXPECT_NEAR(found.regions[0].surface_area_b, kPi * r * r, 1e-5);
  EXPECT_NEAR(found.regions[0].surface_area_a, kPi * r * r + 2.0 * kPi * r * depth, 1e-5);
  EXPECT_NEAR((found.regions[0].normal_in_a + Vector3d::UnitZ()).norm(), 0.0, 1e-12);
  // The depth below a cap, but within the depth of the rim below the side.
  const double sum = kPi * (r * r * depth - depth * depth * (r - depth / 3.0));
  EXPECT_NEAR(sumOf(found, found.regions[0], 1), sum, 1e-5 * sum);
}

bool holds(const Body& mesh, const Vector3d& point) {
  const MeshTopology& topology = mesh->topology();
  return containsPoint(mesh->tree(), mesh->surface(), topology.shell_is_closed, topology.shell_of_triangle,
                       point);
}

TEST(RoundOverlap, AnywhereItAgreesWithFineMeshes) {
  RandomEngine engine(71);
  const std::vector<RoundShape> shapes{roundShape(RoundKind::Sphere, 0.2, 0.0, 2e-4),
                                       roundShape(RoundKind::Capsule, 0.1, 0.2, 1e-4),
                                       roundShape(RoundKind::Cylinder, 0.15, 0.1, 1e-4)};
  int compared = 0;
  for (std::uint32_t i = 0; i < 90; ++i) {
    if (i % 6 == 4) continue;  // a sheet
    const RoundShape& shape = shapes[i % 3];
    const Body mesh = makeBody(test::concaveShape(i / 3 % 4));
    const Isometry3d pose = test::randomPose(engine, 0.5);
    const Interference found = overlapOf(mesh, makeRoundBody(shape), pose);
    const Interference fine = overlapOf(mesh, makeRoundBody(shape, false), pose);
    double volume = 0.0;
    double fine_volume = 0.0;
    double area = 0.0;
    double fine_area = 0.0;
    for (const InterferenceRegion& region : found.regions) {
      volume += region.volume;
      area += region.surface_area_b;
      EXPECT_TRUE(region.consistent);
    }
    for (const InterferenceRegion& region : fine.regions) {
      fine_volume += region.volume;
      fine_area += region.surface_area_b;
    }
    if (fine_volume < 1e-5) continue;
    ++compared;
    EXPECT_EQ(found.regions.size(), fine.regions.size()) << i;
    EXPECT_NEAR(volume, fine_volume, 0.01 * fine_volume + 1e-5) << i << " " << static_cast<int>(shape.kind);
    EXPECT_NEAR(area, fine_area, 0.03 * fine_area + 3e-4) << i << " " << static_cast<int>(shape.kind);
    if (found.regions.size() != 1 || fine.regions.size() != 1) continue;
    // Only one point of the solid's own surface is looked at.
    EXPECT_LE(found.regions[0].depth, 1.02 * fine.regions[0].depth + 1e-3) << i;
    if (fine.regions[0].depth < 0.5 * shape.radius) {
      EXPECT_GE(found.regions[0].depth, 0.98 * fine.regions[0].depth - 1e-3) << i;
    }
    EXPECT_NEAR((found.regions[0].centroid_in_a - fine.regions[0].centroid_in_a).norm(), 0.0, 4e-3) << i;
    if (found.regions[0].normal_is_fallback) continue;
    EXPECT_NEAR((found.regions[0].normal_in_a - fine.regions[0].normal_in_a).norm(), 0.0, 0.02) << i;
  }
  EXPECT_GT(compared, 12);
}

TEST(RoundOverlap, VolumesAreThoseOfMonteCarlo) {
  RandomEngine engine(5);
  const std::vector<RoundShape> shapes{test::sphereOf(0.3), roundShape(RoundKind::Capsule, 0.2, 0.2),
                                       roundShape(RoundKind::Cylinder, 0.25, 0.2)};
  constexpr int kPoints = 100000;
  int compared = 0;
  for (std::uint32_t i = 0; i < 12; ++i) {
    const RoundShape& shape = shapes[i % 3];
    const Body mesh = makeBody(test::concaveShape(i % 4));
    const Isometry3d pose = test::randomPose(engine, 0.4);
    double volume = 0.0;
    for (const InterferenceRegion& region : overlapOf(mesh, makeRoundBody(shape), pose).regions)
      volume += region.volume;
    const double reach = detail::reachOf(shape);
    int inside = 0;
    for (int k = 0; k < kPoints; ++k) {
      const Vector3d point = test::uniformInCube(engine, reach);
      if (detail::signedDistance(shape, point) < 0.0 && holds(mesh, pose * point)) ++inside;
    }
    const double share = static_cast<double>(inside) / kPoints;
    const double cube = std::pow(2.0 * reach, 3);
    EXPECT_NEAR(volume, share * cube, 4.0 * cube * std::sqrt((share + 1e-4) / kPoints)) << i;
    if (inside > 1000) ++compared;
  }
  EXPECT_GT(compared, 4);
}

TEST(RoundOverlap, APlateThroughABallIsOneRegionAndTeethAreSeveral) {
  const Body ball = makeRoundBody(test::sphereOf(0.5));
  const Interference plate =
      overlapOf(makeBody(makeBox({4.0, 4.0, 0.2})), ball, translation({0.1, 0.2, 0.15}));
  ASSERT_EQ(plate.regions.size(), 1U);
  const auto cap = [](double depth) { return kPi * depth * depth * (1.5 - depth) / 3.0; };
  const double slab = cap(0.5 - 0.15 + 0.1) - cap(0.5 - 0.15 - 0.1);
  EXPECT_NEAR(plate.regions[0].volume, slab, 1e-4 * slab);
  EXPECT_EQ(plate.regions[0].loop_count, 2U);
  const Interference teeth =
      overlapOf(makeBody(test::makeComb(3, 0.1, 0.15, 0.4, 0.1, 0.2)), ball, translation({0.3, 0.7, 0.1}));
  EXPECT_EQ(teeth.regions.size(), 3U);
}

TEST(RoundOverlap, ARegionReachesToItsCurves) {
  RandomEngine engine(8);
  const std::vector<RoundShape> shapes{test::sphereOf(0.3), roundShape(RoundKind::Capsule, 0.2, 0.2),
                                       roundShape(RoundKind::Cylinder, 0.25, 0.2)};
  int compared = 0;
  for (std::uint32_t i = 0; i < 24; ++i) {
    const Interference found = overlapOf(makeBody(test::concaveShape(i % 4)), makeRoundBody(shapes[i % 3]),
                                         test::randomPose(engine, 0.4));
    for (const InterferenceRegion& region : found.regions) {
      if (region.facet_count == 0) continue;
      double farthest = 0.0;
      for (std::uint32_t f = 0; f < region.facet_count; ++f) {
        for (const Vector3d& corner : found.facets[region.first_facet + f].corners_in_a)
          farthest = std::max(farthest, (corner - region.centroid_in_a).norm());
      }
      EXPECT_NEAR(region.reach, farthest, 1e-12) << i;
      ++compared;
    }
  }
  EXPECT_GT(compared, 12);
}

TEST(RoundOverlap, WhatIsSwallowedIsARegion) {
  const Body ball = makeRoundBody(test::sphereOf(0.5));
  const Interference held = overlapOf(block(), ball, translation({0.0, 0.0, -1.0}));
  ASSERT_EQ(held.regions.size(), 1U);
  EXPECT_TRUE(held.b_inside_a);
  EXPECT_NEAR(held.regions[0].volume, 4.0 / 3.0 * kPi * 0.125, 1e-12);
  EXPECT_NEAR(held.regions[0].surface_area_b, kPi, 1e-12);
  EXPECT_NEAR(held.regions[0].depth_along_normal, 1.5, 1e-12);
  EXPECT_NEAR((held.regions[0].normal_in_a - Vector3d::UnitZ()).norm(), 0.0, 1e-12);
  const Interference holding =
      overlapOf(makeBody(makeBox({0.1, 0.1, 0.2})), ball, translation({0.1, 0.1, 0.0}));
  ASSERT_EQ(holding.regions.size(), 1U);
  EXPECT_TRUE(holding.a_inside_b);
  EXPECT_NEAR(holding.regions[0].volume, 0.002, 2e-6);
  EXPECT_EQ(holding.regions[0].loop_count, 0U);
}

TEST(RoundOverlap, AnOpenSheetHasNoDepth) {
  const Body sheet = makeBody(test::makeSheet(4, 4));
  const Interference found =
      overlapOf(sheet, makeRoundBody(test::sphereOf(0.1)), translation({0.2, 0.2, 0.05}));
  ASSERT_EQ(found.regions.size(), 1U);
  EXPECT_FALSE(found.regions[0].closed);
  EXPECT_TRUE(std::isnan(found.regions[0].depth));
  EXPECT_EQ(found.regions[0].sample_count, 0U);
}

/// Force of an elastic foundation of stiffness 1 on B, and its torque about A's origin.
void forceOf(const Interference& found, Vector3d& force, Vector3d& torque) {
  force.setZero();
  torque.setZero();
  for (const OverlapSample& sample : found.samples) {
    const Vector3d push = sample.area * sample.depth * sample.push_in_a;
    force += push;
    torque += sample.point_in_a.cross(push);
  }
}

TEST(RoundOverlap, TheFoundationsWorkOnAClosedWayIsNothing) {
  const std::vector<RoundShape> shapes{test::sphereOf(0.3), roundShape(RoundKind::Capsule, 0.2, 0.2),
                                       roundShape(RoundKind::Cylinder, 0.3, 0.1)};
  const Body box = makeBody(makeBox({0.6, 0.5, 0.4}));
  for (const RoundShape& shape : shapes) {
    const Body round = makeRoundBody(shape);
    InterferenceWorkspace workspace;
    Interference found;
    // About an edge of the box, round and round: translation and turn.
    const int steps = 400;
    const auto poseAt = [&](double s) {
      const double reach = shape.kind == RoundKind::Cylinder ? 0.12 : 0.22;
      return turned(0.4 * std::sin(s), {1.0, 0.3, 0.2},
                    {0.3 + 0.1 * std::cos(s), 0.05 * std::sin(2.0 * s), 0.2 + reach + 0.05 * std::sin(s)});
    };
    double work = 0.0;
    double through = 0.0;
    for (int i = 0; i < steps; ++i) {
      // Two Gauss points a step.
      for (const double share : {0.5 - 0.5 / std::sqrt(3.0), 0.5 + 0.5 / std::sqrt(3.0)}) {
        const double width = 2.0 * kPi / steps;
        const double s = (i + share) * width;
        const Isometry3d pose = poseAt(s);
        findInterference(*box, *round, pose, workspace, found);
        Vector3d force;
        Vector3d torque;
        forceOf(found, force, torque);
        const double ds = 1e-5;
        const Isometry3d before = poseAt(s - ds);
        const Isometry3d after = poseAt(s + ds);
        const Eigen::Matrix3d spin =
            (after.linear() - before.linear()) / (2.0 * ds) * pose.linear().transpose();
        const Vector3d omega(spin(2, 1), spin(0, 2), spin(1, 0));
        const Vector3d velocity = (after.translation() - before.translation()) / (2.0 * ds);
        const double power = force.dot(velocity) + (torque - pose.translation().cross(force)).dot(omega);
        work += 0.5 * width * power;
        through += 0.5 * width * std::abs(power);
      }
    }
    EXPECT_GT(through, 1e-6);
    EXPECT_LT(std::abs(work), 1e-4 * through) << static_cast<int>(shape.kind);
  }
}

TEST(RoundOverlap, ADiscThatIsHardlyTiltedHasItsWholeFace) {
  const double r = 0.1;
  const Body disc = makeRoundBody(roundShape(RoundKind::Cylinder, r, 0.02));
  for (const double depth : {1e-7, 1e-5, 1e-3}) {
    for (const double tilt : {0.0, 1e-12, 1e-9, 0.2 * depth, 2.0 * depth}) {
      const Interference found =
          overlapOf(block(), disc, turned(tilt, {1.0, 0.4, 0.0}, {0.01, 0.02, 0.02 - depth}));
      ASSERT_EQ(found.regions.size(), 1U);
      const double area = kPi * r * r;
      EXPECT_NEAR(found.regions[0].surface_area_a, area, 1e-4 * area) << depth << " " << tilt;
      EXPECT_NEAR(found.regions[0].volume, depth * area, 1e-3 * depth * area) << depth << " " << tilt;
    }
  }
}

TEST(RoundOverlap, AWarmCallAllocatesNothing) {
  const Body comb = makeBody(test::makeComb(3));
  const Body cylinder = makeRoundBody(roundShape(RoundKind::Cylinder, 0.1, 0.15));
  const Body ball = makeRoundBody(test::sphereOf(0.2));
  InterferenceWorkspace workspace;
  Interference result;
  std::size_t before = 0;
  for (int round = 0; round < 2; ++round) {
    if (round == 1) before = allocations.load();
    for (int i = 0; i < 50; ++i) {
      const Isometry3d pose = turned(0.1 * i, {1.0, 0.5, 0.2}, {0.01 * i, 0.42, 0.1});
      findInterference(*comb, *cylinder, pose, workspace, result);
      findInterference(*ball, *cylinder, translation({0.25, 0.0, 0.005 * i}), workspace, result);
    }
  }
  EXPECT_EQ(allocations.load() - before, 0U);
}

TEST(RoundOverlap, FarFromTheOriginAndInHugeMeshesItIsTheSame) {
  const double depth = 1e-3;
  const Body ball = makeRoundBody(test::sphereOf(0.05));
  const Interference near = overlapOf(block(), ball, translation({0.3, 0.2, 0.05 - depth}));
  RoundShape shape = test::sphereOf(0.05);
  shape.body_from_shape.translation() = Vector3d(1e6, -1e6, 1e6);
  const Interference far = overlapOf(block(), makeRoundBody(shape),
                                     translation(Vector3d(0.3 - 1e6, 0.2 + 1e6, 0.05 - depth - 1e6)));
  const Interference huge =
      overlapOf(makeBody(makeBox({1e6, 1e6, 2.0})), ball, translation({0.3, 0.2, 1.05 - depth}));
  for (const Interference* found : {&far, &huge}) {
    ASSERT_EQ(found->regions.size(), 1U);
    EXPECT_NEAR(found->regions[0].volume, near.regions[0].volume, 1e-5 * near.regions[0].volume);
    EXPECT_NEAR(found->regions[0].depth, depth, 1e-9);
  }
}

TEST(RoundOverlap, ACylinderThinnerThanAHairIsStillASolid) {
  const Body needle = makeRoundBody(roundShape(RoundKind::Cylinder, 1e-8, 0.5));
  const Interference found = overlapOf(block(), needle, turned(0.3, {0.0, 1.0, 0.0}, {0.0, 0.0, 0.2}));
  ASSERT_EQ(found.regions.size(), 1U);
  // Only the axis' part below the plane counts.
  const double length = 0.5 - 0.2 / std::cos(0.3);
  EXPECT_NEAR(found.regions[0].volume, kPi * 1e-16 * length, 1e-3 * kPi * 1e-16 * length);
}

}  // namespace
}  // namespace concave_distance::round_overlap_test
