#include "distance/niches/local_minima.h"

#include <gtest/gtest.h>

#include "distance/niches/minima_checks.h"
#include "support/thesis_scenes.h"

// The proven list of niches against brute force over all triangle pairs: none invented, none missing.

namespace concave_distance::local_minima_test {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using test::Body;
using test::expectSameAsBruteForce;
using test::makeBody;

TEST(LocalMinima, AreThoseOfBruteForceForConcaveShapesAtRandomPoses) {
  RandomEngine engine(3);
  for (std::uint32_t run = 0; run < 200; ++run) {
    SCOPED_TRACE("run " + std::to_string(run));
    const Body a = makeBody(test::concaveShape(uniformIndex(engine, 6)));
    const Body b = makeBody(test::concaveShape(uniformIndex(engine, 6)));
    const Isometry3d pose = test::randomPose(engine, 1.2);
    expectSameAsBruteForce(a, b, pose, 0.617, run % 2 == 0 ? 0.0 : 1e-2);
    if (HasFailure()) break;
  }
}

TEST(LocalMinima, WithAMarginAreThoseOfBruteForceForPaddedShapes) {
  RandomEngine engine(17);
  for (std::uint32_t run = 0; run < 120; ++run) {
    SCOPED_TRACE("run " + std::to_string(run));
    const Body a = makeBody(test::concaveShape(uniformIndex(engine, 6)));
    const Body b = makeBody(test::concaveShape(uniformIndex(engine, 6)));
    const Isometry3d pose = test::randomPose(engine, 1.2);
    const double margin = test::uniformIn(engine, 0.0, 0.4);
    expectSameAsBruteForce(a, b, pose, 0.617, run % 2 == 0 ? 0.0 : 1e-2, margin);
    if (HasFailure()) break;
  }
}

TEST(LocalMinima, AreThoseOfBruteForceForShapesInLine) {
  // Quarter turns and lattice shifts: faces and edges in parallel, in one plane, in contact.
  RandomEngine engine(5);
  for (std::uint32_t run = 0; run < 100; ++run) {
    SCOPED_TRACE("run " + std::to_string(run));
    const Body a = makeBody(test::concaveShape(uniformIndex(engine, 4)));
    const Body b = makeBody(test::concaveShape(uniformIndex(engine, 4)));
    Isometry3d pose = Isometry3d::Identity();
    for (int axis = 0; axis < 3; ++axis) {
      const double quarter = 0.5 * M_PI * uniformIndex(engine, 4);
      pose.linear() = AngleAxisd(quarter, Vector3d::Unit(axis)).toRotationMatrix() * pose.linear();
      pose.translation()[axis] = 0.05 * (static_cast<double>(uniformIndex(engine, 33)) - 16.0);
    }
    if (uniformIndex(engine, 2) == 0) pose.linear() = pose.linear().array().round().matrix();
    expectSameAsBruteForce(a, b, pose, 0.617, run % 2 == 0 ? 0.0 : 1e-2);
    if (HasFailure()) break;
  }
}

TEST(LocalMinima, AreThoseOfBruteForceForLinkedRings) {
  const Body a = makeBody(test::makeRing(0.5, 0.1, 14, 6));
  const Body b = makeBody(test::makeRing(0.5, 0.1, 14, 6));
  RandomEngine engine(7);
  for (int run = 0; run < 4; ++run) {
    Isometry3d pose = test::translation(Vector3d(0.5, 0, 0) + test::uniformInCube(engine, 0.1));
    pose.linear() = (AngleAxisd(0.5 * M_PI, Vector3d::UnitX()) *
                     AngleAxisd(test::uniformIn(engine, -0.3, 0.3), Vector3d::UnitZ()))
                        .toRotationMatrix();
    expectSameAsBruteForce(a, b, pose, 0.617, run % 2 == 0 ? 0.0 : 1e-2);
  }
}

TEST(LocalMinima, AreThoseOfBruteForceForAPegInAHole) {
  // The ring's tube is a hole of 0.4 with 18 corners, the peg one of 0.38 with 14.
  const Body a = makeBody(test::makeRing(0.5, 0.1, 18, 4));
  std::vector<Eigen::Vector2d> round;
  for (int k = 0; k < 14; ++k) {
    round.emplace_back(0.38 * std::cos(2.0 * M_PI * k / 14), 0.38 * std::sin(2.0 * M_PI * k / 14));
  }
  const Body b = makeBody(test::makeExtrusion(round, 0.8));
  RandomEngine engine(8);
  for (int run = 0; run < 4; ++run) {
    Isometry3d pose = test::translation(test::uniformInCube(engine, 0.004));
    pose.linear() = (AngleAxisd(0.01, Vector3d::UnitX()) *
                     AngleAxisd(test::uniformIn(engine, -0.3, 0.3), Vector3d::UnitZ()))
                        .toRotationMatrix();
    expectSameAsBruteForce(a, b, pose, 0.2, run % 2 == 0 ? 0.0 : 1e-2);
  }
}

TEST(LocalMinima, AreThoseOfBruteForceForBrokenSurfaces) {
  // A box with a zero-area triangle along an edge, a needle over a face, a hole, and a fin on an edge that
  // three triangles share; turned winding on the other body.
  const SurfaceMesh box = test::makeCuboid(Vector3d(-0.3, -0.2, -0.1), Vector3d(0.3, 0.2, 0.1));
  std::vector<Vector3d> vertices = box.vertices();
  std::vector<TriangleNodes> triangles(box.triangles().begin() + 1, box.triangles().end());
  const auto add = [&](const Vector3d& v) {
    vertices.push_back(v);
    return NodeIndex{vertices.size() - 1};
  };
  const NodeIndex on_edge = add(0.5 * (vertices[0] + vertices[1]));
  const NodeIndex fin = add(Vector3d(0.0, -0.4, -0.25));
  const NodeIndex needle = add(vertices[7] + Vector3d(0.3, 1e-9, 0.2));
  triangles.push_back({NodeIndex{0}, on_edge, NodeIndex{1}});
  triangles.push_back({NodeIndex{0}, NodeIndex{1}, fin});
  triangles.push_back({NodeIndex{7}, add(vertices[7] + Vector3d(0.3, 0.0, 0.2)), needle});
  const Body a = makeBody(SurfaceMesh(vertices, triangles, "broken box"));
  const Body b = makeBody(test::makeTurned(test::makeLShape()));
  RandomEngine engine(9);
  for (std::uint32_t run = 0; run < 60; ++run) {
    SCOPED_TRACE("run " + std::to_string(run));
    expectSameAsBruteForce(a, b, test::randomPose(engine, 0.9), 0.5, run % 2 == 0 ? 0.0 : 1e-2);
    if (HasFailure()) break;
  }
}

TEST(LocalMinima, AreThoseOfBruteForceForManyTrianglesAtOneEdge) {
  std::vector<Vector3d> vertices{Vector3d(0.0, 0.0, -0.3), Vector3d(0.0, 0.0, 0.3)};
  std::vector<TriangleNodes> triangles;
  RandomEngine engine(12);
  for (std::uint32_t page = 0; page < 24; ++page) {
    const double angle = 2.0 * M_PI * page / 24.0;
    vertices.emplace_back(0.4 * std::cos(angle), 0.4 * std::sin(angle), test::uniformIn(engine, -0.3, 0.3));
    triangles.push_back({NodeIndex{page % 2}, NodeIndex{1 - page % 2}, NodeIndex{2 + page}});
  }
  const Body a = makeBody(SurfaceMesh(vertices, triangles, "book"));
  const Body b = makeBody(test::makeLShape());
  for (std::uint32_t run = 0; run < 30; ++run) {
    SCOPED_TRACE("run " + std::to_string(run));
    expectSameAsBruteForce(a, b, test::randomPose(engine, 1.2), 0.8, run % 2 == 0 ? 0.0 : 1e-2);
    if (HasFailure()) break;
  }
}

TEST(LocalMinima, OfTheBatteryInItsFixtureAreNineOutwards) {
  const test::ThesisScene s = test::loadThesisScene("battery_static", 1.0);
  const LocalMinima found = test::minimaOf(s.a, s.b, s.a_from_b, LocalMinimaRequest{});
  const double table[] = {0.0757, 0.1336, 0.1499, 0.2039, 0.2953, 0.2971, 0.3731, 0.3938, 0.4026};
  ASSERT_EQ(found.niches.size(), std::size(table));
  for (std::size_t i = 0; i < std::size(table); ++i) {
    // The table's are distances between nodes: not below those of the surfaces.
    EXPECT_LE(found.niches[i].distance, table[i] + 1e-4);
    EXPECT_GT(found.niches[i].distance, 0.98 * table[i]);
    EXPECT_EQ(found.niches[i].outward, Outwardness::Outward);
    EXPECT_GE(found.niches[i].prominence, 1e-2);
  }
  EXPECT_EQ(found.cost.met_by_search, 0U);
  expectSameAsBruteForce(s.a, s.b, s.a_from_b, 0.45, 1e-2);
}

}  // namespace
}  // namespace concave_distance::local_minima_test
