// Volume, centroid and area of what a mesh cuts off an exact round solid, most of all near its centre and
// axis.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "mesh/surface/refine_mesh.h"
#include "mesh/surface/round_geometry.h"
#include "support/round_bodies.h"
#include "support/round_cuts.h"

namespace concave_distance::round_volume_test {
namespace {

using Body = std::shared_ptr<const BodyMesh>;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using test::makeBody;
using test::makeRoundBody;
using test::overlapOf;
using test::roundShape;

/// The worst errors: of the volume in units of it, of centroid and surface in those of the solid.
struct Worst {
  double volume = 0.0;
  double centroid = 0.0;
  double area = 0.0;
};

/// Compares the sum of the regions.
void compare(const RoundShape& shape, const Interference& found, const test::RoundCut& truth,
             const Isometry3d& a_from_shape, Worst& worst) {
  double volume = 0.0;
  double area = 0.0;
  Vector3d moment = Vector3d::Zero();
  for (const InterferenceRegion& region : found.regions) {
    volume += region.volume;
    area += region.surface_area_b;
    moment += region.volume * region.centroid_in_a;
  }
  const Vector3d middle = a_from_shape * Vector3d(truth.moment / truth.volume);
  const double centroid = volume > 0.0 ? (moment / volume - middle).norm() : 1.0;
  worst.volume = std::max(worst.volume, std::abs(volume - truth.volume) / truth.volume);
  worst.centroid = std::max(worst.centroid, centroid / detail::reachOf(shape));
  worst.area = std::max(worst.area, std::abs(area - truth.area) / detail::surfaceAreaOf(shape));
}

void expectRight(const Worst& worst, double tolerance) {
  EXPECT_LT(worst.volume, tolerance);
  EXPECT_LT(worst.centroid, tolerance);
  EXPECT_LT(worst.area, tolerance);
}

/// The mesh of a round body is looked at by nothing here.
Body coarseBody(RoundShape shape) {
  shape.chord_error = 0.3 * shape.radius;
  return makeRoundBody(shape);
}

Vector3d directionFrom(RandomEngine& engine) {
  for (;;) {
    const Vector3d direction = test::uniformInCube(engine, 1.0);
    if (direction.norm() > 0.1 && direction.norm() < 1.0) return direction.normalized();
  }
}

RoundShape shapeFrom(RandomEngine& engine, int kind) {
  const double radius = test::uniformIn(engine, 0.05, 0.25);
  if (kind == 0) return test::sphereOf(radius);
  const double half_length = radius * std::pow(10.0, test::uniformIn(engine, -1.0, 0.7));
  return roundShape(kind == 1 ? RoundKind::Capsule : RoundKind::Cylinder, radius, half_length);
}

/// Upper face at z = 0, if fanned with a vertex at the origin, so that vertices and edges come near the core.
SurfaceMesh blockOf(bool is_fanned) {
  const SurfaceMesh box = makeBox({8.0, 8.0, 8.0});
  std::vector<Vector3d> vertices;
  for (const Vector3d& vertex : box.vertices()) vertices.push_back(vertex - 4.0 * Vector3d::UnitZ());
  vertices.push_back(Vector3d::Zero());
  const NodeIndex apex{static_cast<std::uint32_t>(vertices.size() - 1)};
  std::vector<TriangleNodes> triangles;
  for (const TriangleNodes& nodes : box.triangles()) {
    const auto is_top = [&](std::size_t k) { return vertices[nodes[k % 3].value].z() == 0.0; };
    if (!is_fanned || !(is_top(0) && is_top(1) && is_top(2))) {
      triangles.push_back(nodes);
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d along = vertices[nodes[(k + 1) % 3].value] - vertices[nodes[k].value];
      if (along.x() == 0.0 || along.y() == 0.0) triangles.push_back({nodes[k], nodes[(k + 1) % 3], apex});
    }
  }
  if (!is_fanned) vertices.pop_back();
  return SurfaceMesh(vertices, triangles, "block");
}

/// Half of them within 1e-6 of the centre, from 1e-17 of the size and exactly through it.
double offsetFrom(RandomEngine& engine, const RoundShape& shape, const Vector3d& normal, bool is_near) {
  if (is_near) {
    const double exponent = test::uniformIn(engine, -18.0, -6.0);
    const double sign = test::uniformIn(engine, -1.0, 1.0);
    return exponent < -17.0 ? 0.0 : std::copysign(std::pow(10.0, exponent), sign);
  }
  const double reach = normal.dot(detail::supportPoint(shape, normal));
  return reach * test::uniformIn(engine, -0.999, 0.999);
}

/// Where the solid is so that what has normal . p <= offset is below z = 0.
Isometry3d poseOfCut(RandomEngine& engine, const Vector3d& normal, double offset, double sideways) {
  const Eigen::AngleAxisd spin(test::uniformIn(engine, -kPi, kPi), Vector3d::UnitZ());
  Eigen::Matrix3d upright;
  upright << normal.unitOrthogonal(), Vector3d::Zero(), normal;
  upright.col(1) = normal.cross(upright.col(0));
  Isometry3d pose(spin * upright.transpose());
  pose.translation() = Vector3d(test::uniformIn(engine, -1.0, 1.0) * sideways,
                                test::uniformIn(engine, -1.0, 1.0) * sideways, -offset);
  return pose;
}

/// Directions along and across the axis, and nearly so, are as frequent as others.
Vector3d normalFrom(RandomEngine& engine, int i) {
  Vector3d normal = directionFrom(engine);
  const double tilt = i % 7 == 0 ? 0.0 : std::pow(10.0, test::uniformIn(engine, -16.0, -1.0));
  if (i % 3 == 0) normal.z() *= tilt;
  if (i % 3 == 1) normal.head<2>() *= tilt;
  return normal.normalized();
}

TEST(RoundVolume, TenThousandCutsHalfOfThemThroughTheCoreAreThoseOfTheDiscs) {
  RandomEngine engine(20331);
  const std::vector<Body> blocks{makeBody(blockOf(false)), makeBody(blockOf(true))};
  for (int kind = 0; kind < 3; ++kind) {
    Worst near;
    Worst far;
    for (int i = 0; i < 10000; ++i) {
      if (i % 3 != kind) continue;
      const bool is_near = i % 2 == 0;
      const RoundShape shape = shapeFrom(engine, kind);
      const Vector3d normal = normalFrom(engine, static_cast<int>(engine() % 21));
      const double offset = offsetFrom(engine, shape, normal, is_near);
      const double sideways = i % 4 < 2 ? 0.3 : std::pow(10.0, test::uniformIn(engine, -18.0, -6.0));
      const Isometry3d pose = poseOfCut(engine, normal, offset, sideways);
      const Interference found =
          overlapOf(blocks[static_cast<std::size_t>(i / 6 % 2)], coarseBody(shape), pose);
      const test::RoundCut truth = test::cutOff(shape, normal, offset);
      compare(shape, found, truth, pose, is_near ? near : far);
    }
    expectRight(near, 1e-7);
    expectRight(far, 1e-5);
  }
}

TEST(RoundVolume, ThinSlicesThroughTheCoreAreDifferencesOfCuts) {
  RandomEngine engine(402);
  Worst worst;
  for (int i = 0; i < 600; ++i) {
    const RoundShape shape = shapeFrom(engine, i % 3);
    const Vector3d normal = normalFrom(engine, i % 21);
    const double offset = offsetFrom(engine, shape, normal, i % 2 == 0);
    const double thickness = std::pow(10.0, test::uniformIn(engine, -4.0, -1.0));
    const Body plate = makeBody(makeBox({8.0, 8.0, thickness}));
    Isometry3d pose = poseOfCut(engine, normal, offset, 0.3);
    pose.translation().z() += 0.5 * thickness;
    const test::RoundCut above = test::cutOff(shape, normal, offset);
    const test::RoundCut below = test::cutOff(shape, normal, offset - thickness);
    const test::RoundCut truth{above.volume - below.volume, above.area - below.area,
                               above.moment - below.moment};
    compare(shape, overlapOf(plate, coarseBody(shape), pose), truth, pose, worst);
  }
  expectRight(worst, 1e-5);
}

/// Of a box with a corner at the centre, or an edge through it, or wholly inside.
TEST(RoundVolume, EdgesAndCornersAtTheCoreLeaveQuartersAndEighths) {
  RandomEngine engine(77);
  Worst worst;
  for (int i = 0; i < 900; ++i) {
    const RoundShape shape = shapeFrom(engine, i % 3);
    const bool is_corner = i % 2 == 0;
    Isometry3d shape_from_box(Eigen::AngleAxisd(test::uniformIn(engine, -kPi, kPi), Vector3d::UnitZ()));
    if (shape.kind == RoundKind::Sphere) shape_from_box = test::randomPose(engine, 0.0);
    const double off = i % 5 == 0 ? 0.0 : std::pow(10.0, test::uniformIn(engine, -18.0, -8.0));
    const Vector3d corner = off * test::uniformInCube(engine, 1.0);
    shape_from_box.translation() = corner + shape_from_box * Vector3d(2.0, 2.0, is_corner ? 2.0 : 0.3);
    const Isometry3d box_from_shape = shape_from_box.inverse(Eigen::Isometry);
    const double share = is_corner ? 0.125 : 0.25;
    test::RoundCut truth{share * volumeOf(shape), share * detail::surfaceAreaOf(shape), Vector3d::Zero()};
    // By the moments of two halves across each other, of the eighth also along the axis.
    const Vector3d half = test::cutOff(shape, -Vector3d::UnitX(), 0.0).moment;
    const Vector3d upper = test::cutOff(shape, -Vector3d::UnitZ(), 0.0).moment;
    const Vector3d in_box(0.5 * half.x(), 0.5 * half.x(), 0.0);
    truth.moment = shape_from_box.linear() * (is_corner ? Vector3d(0.5 * in_box + 0.25 * upper) : in_box);
    compare(shape, overlapOf(makeBody(makeBox({4.0, 4.0, 4.0})), coarseBody(shape), box_from_shape), truth,
            box_from_shape, worst);
  }
  expectRight(worst, 1e-6);
}

TEST(RoundVolume, ARodThroughABallIsTheIntegralOfItsLength) {
  const RoundShape ball = test::sphereOf(0.25);
  const Body rod = makeBody(makeBox({0.1, 0.1, 3.0}));
  Worst worst;
  for (const double aside : {0.0, 1e-12, 0.03, 0.05 - 1e-9, 0.05, 0.05 + 1e-15, 0.0501}) {
    for (const double askew : {0.0, 0.05}) {
      test::RoundCut truth;
      test::overInterval(aside - 0.05, aside + 0.05, [&](double x, double weight) {
        test::overInterval(askew - 0.05, askew + 0.05, [&](double y, double share) {
          const double half = std::sqrt(0.0625 - x * x - y * y);
          truth.volume += 2.0 * half * weight * share;
          truth.area += 0.5 / half * weight * share;
          truth.moment += 2.0 * half * weight * share * Vector3d(x, y, 0.0);
        });
      });
      const Isometry3d pose = test::translation({-aside, -askew, 0.0});
      compare(ball, overlapOf(rod, makeRoundBody(ball), pose), truth, pose, worst);
    }
  }
  expectRight(worst, 1e-7);
}

/// Two boxes that share the slab -0.1 <= x <= 0.1, one shell each, the second finely cut so that some of its
/// triangles are hidden in the first.
TEST(RoundVolume, ShellsThatOverlapCountTwiceWhatTheyShareAndNeverMoreThanTheSolid) {
  const auto box_at = [](double x, double edge) {
    SurfaceMesh box = makeBox({2.0, 2.0, 2.0});
    if (edge > 0.0) box = refineToEdgeLength(box, edge).mesh;
    std::vector<Vector3d> vertices;
    for (const Vector3d& vertex : box.vertices()) vertices.push_back(vertex + Vector3d(x, 0.0, -1.0));
    return SurfaceMesh(vertices, box.triangles(), "box");
  };
  const SurfaceMesh first = box_at(-0.9, 0.0);
  int compared = 0;
  for (const double edge : {0.0, 0.15}) {
    const SurfaceMesh second = box_at(0.9, edge);
    std::vector<Vector3d> vertices = first.vertices();
    std::vector<TriangleNodes> triangles = first.triangles();
    const auto offset = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), second.vertices().begin(), second.vertices().end());
    for (TriangleNodes nodes : second.triangles()) {
      for (NodeIndex& node : nodes) node.value += offset;
      triangles.push_back(nodes);
    }
    const Body both = makeBody(SurfaceMesh(vertices, triangles, "two boxes"));
    const Body one = makeBody(first);
    const Body other = makeBody(second);
    const RoundShape ball = test::sphereOf(0.3);
    for (const double x : {-0.5, -0.31, -0.1, 0.0, 0.05, 0.2, 0.37}) {
      for (const double z : {-0.2, -0.05, 0.0, 0.1}) {
        const Isometry3d pose = test::translation({x, 0.0, z});
        const auto volume = [&](const Body& body) {
          double sum = 0.0;
          for (const InterferenceRegion& region : overlapOf(body, makeRoundBody(ball), pose).regions)
            sum += region.volume;
          return sum;
        };
        const double expected = std::min(volumeOf(ball), volume(one) + volume(other));
        if (overlapOf(both, makeRoundBody(ball), pose).regions.size() != 1) continue;
        ++compared;
        EXPECT_NEAR(volume(both), expected, 1e-9) << edge << " " << x << " " << z;
      }
    }
  }
  EXPECT_GT(compared, 12);
}

TEST(RoundVolume, WhatIsSwallowedHasItsOwnVolumeWhereverItLies) {
  RandomEngine engine(5);
  Worst worst;
  for (int i = 0; i < 600; ++i) {
    const RoundShape shape = shapeFrom(engine, i % 3);
    const double size = shape.radius * std::pow(10.0, test::uniformIn(engine, -5.0, -0.5));
    const Vector3d sizes = size * (Vector3d::Constant(1.1) + test::uniformInCube(engine, 1.0));
    const Body box = makeBody(makeBox(sizes));
    const double room = std::min(shape.radius, shape.kind == RoundKind::Cylinder ? shape.half_length : 1.0);
    if (sizes.norm() > 0.5 * room) continue;
    Isometry3d shape_from_box = test::randomPose(engine, i % 2 == 0 ? 0.0 : 0.4 * room);
    const Isometry3d pose = shape_from_box.inverse(Eigen::Isometry);
    const test::RoundCut truth{sizes.prod(), 0.0, sizes.prod() * shape_from_box.translation()};
    compare(shape, overlapOf(box, coarseBody(shape), pose), truth, pose, worst);
  }
  expectRight(worst, 1e-9);
}

}  // namespace
}  // namespace concave_distance::round_volume_test
