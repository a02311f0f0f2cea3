// How deep the surfaces of an overlap lie in each other: integrals against closed forms, and the depth.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/constants.h"
#include "base/random_engine.h"
#include "distance/bound/closest_point.h"
#include "interference/interference_checks.h"
#include "mesh/surface/mesh_topology.h"
#include "mesh/trees/triangle_tree.h"
#include "support/concave_shapes.h"
#include "support/random_solids.h"

namespace concave_distance::overlap_samples_test {
namespace {

/// Sums over a region's samples, with unit stiffness.
struct Push {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();
  double volume = 0.0;
};

Push pushOf(const Interference& result) {
  Push push;
  for (const OverlapSample& sample : result.samples) {
    const Eigen::Vector3d force = sample.area * sample.depth * sample.push_in_a;
    push.force += force;
    push.torque += sample.point_in_a.cross(force);
    push.volume += sample.area * sample.depth;
  }
  return push;
}

Eigen::Isometry3d at(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

TEST(OverlapSamples, OfABoxOnAPlateAddUpToThePrismAndTheFrustum) {
  const double width = 0.1;
  for (const double depth : {1e-5, 1e-4, 1e-3, 1e-2}) {
    const Interference result = test::interferenceOf(makeBox({1, 1, 0.2}), makeBox({width, width, width}),
                                                     at(0.03, 0.02, 0.1 + width / 2 - depth));
    ASSERT_EQ(result.regions.size(), 1U);
    EXPECT_NEAR(result.regions[0].depth, depth, 1e-12);
    // The box's face lies `depth` deep, its sides from 0 to that; the plate's face is as deep in the box as
    // its sides let it be: a frustum.
    const double face = width * width * depth;
    const double inner = width - 2.0 * depth;
    const double frustum = depth / 3.0 * (width * width + inner * inner + width * inner);
    const Push push = pushOf(result);
    EXPECT_NEAR(push.force.z(), 0.5 * (face + frustum), 5e-3 * face) << depth;
    EXPECT_NEAR(push.volume, 0.5 * (face + frustum + 2.0 * width * depth * depth), 5e-3 * face) << depth;
    EXPECT_LT(push.force.head<2>().norm(), 1e-3 * push.force.z()) << depth;
  }
}

TEST(OverlapSamples, AWorkspaceMayBeUsedForOtherBodiesAtTheSameAddress) {
  InterferenceWorkspace workspace;
  std::optional<BodyMesh> ball;
  std::optional<BodyMesh> plate;
  for (const bool fine : {true, false, true, false}) {
    ball.emplace("ball", makeSphere(0.1, fine ? 1e-4 : 0.02));
    plate.emplace("plate", fine ? makeSphere(1.0, 1e-3) : makeBox({1, 1, 0.2}));
    const Eigen::Isometry3d pose = at(0.01, 0.02, fine ? 1.09 : 0.19);
    Interference used;
    findInterference(*plate, *ball, pose, workspace, used);
    InterferenceWorkspace fresh;
    Interference alone;
    findInterference(*plate, *ball, pose, fresh, alone);
    ASSERT_EQ(used.regions.size(), 1U);
    EXPECT_EQ(used.regions[0].depth, alone.regions[0].depth);
  }
}

TEST(OverlapSamples, OfABallOnAPlateAreThoseOfAParaboloid) {
  const double radius = 0.1;
  const double depth = 1e-3;
  const Interference result = test::interferenceOf(makeBox({1, 1, 0.2}), makeSphere(radius, 1e-5),
                                                   at(0.0013, 0.0007, 0.1 + radius - depth));
  ASSERT_EQ(result.regions.size(), 1U);
  const double cap = kPi * radius * depth * depth;
  EXPECT_NEAR(pushOf(result).force.z(), cap, 0.03 * cap);
}

TEST(OverlapSamples, OfAPegInATightHoleAreAsDeepAsItIsTooWide) {
  const SurfaceMesh plate = test::makePlateWithHole(0.05, 0.01, 0.02, 256);
  const SurfaceMesh peg = makeCylinder(0.01005, 0.06, 1e-6);
  for (const double shift : {0.0, 5e-5, 1.5e-4}) {
    const Interference result = test::interferenceOf(plate, peg, at(shift, 0.0, 0.0));
    ASSERT_FALSE(result.regions.empty());
    EXPECT_NEAR(result.regions[0].depth, 5e-5 + shift, 5e-6) << shift;
    const Push push = pushOf(result);
    if (shift == 0.0) {
      EXPECT_LT(push.force.norm(), 0.02 * push.volume);
    } else {
      EXPECT_LT(push.force.x(), -0.2 * push.volume) << "pushed back";
    }
  }
}

TEST(OverlapSamples, InACornerPushAwayFromBothWalls) {
  // A floor and a wall in one mesh; a box that is 1e-4 into the one and 2e-4 into the other.
  const SurfaceMesh corner =
      test::makeExtrusion({{0, 0}, {1, 0}, {1, 0.2}, {0.2, 0.2}, {0.2, 1}, {0, 1}}, 1.0);
  const double width = 0.1;
  const Interference result = test::interferenceOf(corner, makeBox({width, width, width}),
                                                   at(0.2 + width / 2 - 2e-4, 0.2 + width / 2 - 1e-4, 0.0));
  ASSERT_EQ(result.regions.size(), 1U);
  const Push push = pushOf(result);
  EXPECT_NEAR(push.force.x(), width * width * 2e-4, 0.02 * width * width * 2e-4);
  EXPECT_NEAR(push.force.y(), width * width * 1e-4, 0.02 * width * width * 1e-4);
  // The box's edge is as far from both: the corner's edge is the nearest there.
  EXPECT_NEAR(result.regions[0].depth, std::hypot(1e-4, 2e-4), 1e-9);
}

TEST(OverlapSamples, PushWithoutGivingEnergyOnAClosedWay) {
  const SurfaceMesh plate = makeBox({1, 1, 0.2});
  const SurfaceMesh box = makeBox({0.1, 0.1, 0.1});
  constexpr int kSteps = 400;
  const auto pose = [](double angle) {
    // Sinks, slides over the plate's edge, and rocks.
    Eigen::Isometry3d p = at(0.46 + 0.03 * std::cos(angle), 0.02, 0.148 + 5e-4 * std::sin(angle));
    p.rotate(Eigen::AngleAxisd(0.01 * std::sin(2.0 * angle + 0.4), Eigen::Vector3d::UnitY()));
    return p;
  };
  double work = 0.0;
  double way = 0.0;
  for (int k = 0; k < kSteps; ++k) {
    const Eigen::Isometry3d before = pose(2.0 * kPi * k / kSteps);
    const Eigen::Isometry3d after = pose(2.0 * kPi * (k + 1) / kSteps);
    const Eigen::Isometry3d middle = pose(2.0 * kPi * (k + 0.5) / kSteps);
    const Push push = pushOf(test::interferenceOf(plate, box, middle));
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(after.linear() * before.linear().transpose()));
    const Eigen::Vector3d about = middle.translation();
    const double step = push.force.dot(after.translation() - before.translation()) +
                        (push.torque - about.cross(push.force)).dot(turn.angle() * turn.axis());
    work += step;
    way += std::abs(step);
  }
  EXPECT_LT(std::abs(work), 5e-3 * way);
}

/// The deepest of a grid of points on all facets of a region.
double deepestOfGrid(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                     const Interference& found, const InterferenceRegion& region) {
  constexpr int kSteps = 12;
  double deepest = 0.0;
  for (std::uint32_t f = 0; f < region.facet_count; ++f) {
    const OverlapFacet& facet = found.facets[region.first_facet + f];
    const auto& [p, q, r] = facet.corners_in_a;
    const BodyMesh& other = facet.of_b ? a : b;
    TriangleIndex hint{0};
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; i + j <= kSteps; ++j) {
        const Eigen::Vector3d point = p + (q - p) * i / kSteps + (r - p) * j / kSteps;
        const Eigen::Vector3d target = facet.of_b ? point : Eigen::Vector3d(a_from_b.inverse() * point);
        if (!containsPoint(other.tree(), other.surface(), other.topology().shell_is_closed,
                           other.topology().shell_of_triangle, target))
          continue;
        const SurfacePoint nearest = closestPoint(other, target, hint);
        hint = nearest.triangle;
        deepest = std::max(deepest, std::sqrt(nearest.squared_distance));
      }
    }
  }
  return deepest;
}

TEST(OverlapSamples, NoPlaceOfARegionIsMuchDeeper) {
  int regions = 0;
  int off = 0;
  for (std::uint64_t seed = 0; seed < 80; ++seed) {
    RandomEngine engine(seed);
    const SurfaceMesh a = test::randomSolid(engine);
    const SurfaceMesh b = test::randomSolid(engine);
    const Eigen::Isometry3d pose = test::randomOverlappingPose(a, b, engine);
    const BodyMesh body_a("a", a);
    const BodyMesh body_b("b", b);
    const Interference found = test::interferenceOf(body_a, body_b, pose);
    for (const InterferenceRegion& region : found.regions) {
      if (!(region.depth > 0.0) || region.facet_count == 0) continue;
      const double deepest = deepestOfGrid(body_a, body_b, pose, found, region);
      EXPECT_GE(region.depth, 0.97 * deepest) << seed;
      off += region.depth < deepest / 1.01 ? 1 : 0;
      ++regions;
    }
  }
  EXPECT_GT(regions, 80);
  EXPECT_LE(off, regions / 100);
}

TEST(OverlapSamples, TheDepthChangesByNoMoreThanTheWay) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    RandomEngine engine(seed);
    const SurfaceMesh a = test::randomSolid(engine);
    const SurfaceMesh b = test::randomSolid(engine);
    Eigen::Isometry3d pose = test::randomOverlappingPose(a, b, engine);
    const auto greatest = [&] {
      double depth = 0.0;
      for (const InterferenceRegion& region : test::interferenceOf(a, b, pose).regions)
        depth = std::max(depth, std::isnan(region.depth) ? 0.0 : region.depth);
      return depth;
    };
    double last = greatest();
    for (int k = 0; k < 5; ++k) {
      const double way = 1e-3;
      pose.translation().x() += way;
      const double now = greatest();
      EXPECT_LE(std::abs(now - last), way + 2e-2 * std::max(now, last)) << seed << " " << k;
      last = now;
    }
  }
}

}  // namespace
}  // namespace concave_distance::overlap_samples_test
