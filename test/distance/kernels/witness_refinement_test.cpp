#include "distance/kernels/witness_refinement.h"
#include "mesh/surface/mesh_topology.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/body_pairs.h"
#include "support/enumeration.h"

namespace concave_distance::witness_refinement_test {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test::makeBody;

TrianglePoints cornersInA(const BodyMesh& body, TriangleIndex t, const Isometry3d& a_from_body) {
  return {a_from_body * body.surface().corner(t, 0), a_from_body * body.surface().corner(t, 1),
          a_from_body * body.surface().corner(t, 2)};
}

std::vector<TrianglePoints> trianglesAt(const BodyMesh& body, const Isometry3d& a_from_body,
                                        const Vector3d& point, double tolerance) {
  std::vector<TrianglePoints> found;
  for (std::uint32_t t = 0; t < body.surface().triangleCount(); ++t) {
    const TrianglePoints corners = cornersInA(body, TriangleIndex{t}, a_from_body);
    if (std::sqrt(pointTriangleDistance(point, corners).squared_distance) <= tolerance)
      found.push_back(corners);
  }
  return found;
}

/// By geometry alone, without the topology: every triangle of either body that comes near its witness, paired
/// with every one of the other.
void expectLocalMinimum(const BodyMesh& a, const BodyMesh& b, const Isometry3d& a_from_b,
                        const WitnessPair& witness) {
  const double largest =
      std::max(witness.point_a_in_a.cwiseAbs().maxCoeff(), witness.point_b_in_a.cwiseAbs().maxCoeff()) + 3.0;
  const double tolerance = 2.0 * kTriangleDistanceError * largest;
  const double d = std::sqrt(witness.squared_distance);
  const auto around_a = trianglesAt(a, Isometry3d::Identity(), witness.point_a_in_a, tolerance);
  const auto around_b = trianglesAt(b, a_from_b, witness.point_b_in_a, tolerance);
  ASSERT_FALSE(around_a.empty());
  ASSERT_FALSE(around_b.empty());
  for (const TrianglePoints& triangle_a : around_a) {
    for (const TrianglePoints& triangle_b : around_b) {
      EXPECT_GE(std::sqrt(triangleDistance(triangle_a, triangle_b).squared_distance), d - 2.0 * tolerance);
    }
  }
  EXPECT_NEAR((witness.point_b_in_a - witness.point_a_in_a).norm(), d, tolerance);
}

TEST(RefineWitness, EndsAtALocalMinimumFromEveryStart) {
  RandomEngine engine(1);
  RefinementWorkspace workspace;
  for (std::uint32_t round = 0; round < 18; ++round) {
    const auto a = makeBody(test::concaveShape(round));
    const auto b = makeBody(test::concaveShape(round / 3));
    const Isometry3d pose = test::randomPose(engine, 1.5);
    for (std::uint32_t start = 0; start < 60; ++start) {
      const TriangleIndex start_a{
          uniformIndex(engine, static_cast<std::uint32_t>(a->surface().triangleCount()))};
      const TriangleIndex start_b{
          uniformIndex(engine, static_cast<std::uint32_t>(b->surface().triangleCount()))};
      const WitnessRefinement refined = refineWitness(*a, *b, pose, start_a, start_b, workspace);
      ASSERT_TRUE(refined.proven);
      const TrianglePairDistance before =
          triangleDistance(cornersInA(*a, start_a, Isometry3d::Identity()), cornersInA(*b, start_b, pose));
      EXPECT_LE(std::sqrt(refined.witness.squared_distance),
                std::sqrt(before.squared_distance) + 3.0 * kTriangleDistanceError);
      expectLocalMinimum(*a, *b, pose, refined.witness);
      const WitnessRefinement again =
          refineWitness(*a, *b, pose, refined.witness.triangle_a, refined.witness.triangle_b, workspace);
      EXPECT_EQ(again.iterations, 1U);
      EXPECT_TRUE(again.proven);
    }
  }
}

TEST(RefineWitness, FindsTheDistanceOfConvexBodiesFromAnyFacingStart) {
  // Each of two convex bodies seen from the other has one local minimum on the sides that face each other.
  RandomEngine engine(2);
  RefinementWorkspace workspace;
  const auto a = makeBody(makeSphere(0.6, 0.01));
  const auto b = makeBody(test::makeCuboid(Vector3d(-0.2, -0.3, -0.4), Vector3d(0.2, 0.3, 0.4)));
  for (int i = 0; i < 40; ++i) {
    Isometry3d pose = test::randomPose(engine, 0.2);
    pose.translation() += 1.5 * test::randomRotation(engine).col(0);
    const WitnessPair exact = test::enumerateTrianglePairs(*a, *b, pose);
    int starts = 0;
    for (std::uint32_t k = 0; k < 200 && starts < 20; ++k) {
      const TriangleIndex start_a{
          uniformIndex(engine, static_cast<std::uint32_t>(a->surface().triangleCount()))};
      const TriangleIndex start_b{
          uniformIndex(engine, static_cast<std::uint32_t>(b->surface().triangleCount()))};
      const TrianglePairDistance start =
          triangleDistance(cornersInA(*a, start_a, Isometry3d::Identity()), cornersInA(*b, start_b, pose));
      const Vector3d direction = start.point_b - start.point_a;
      if (direction.dot(a->topology().triangle_normals[start_a.value]) <= 0.0 ||
          direction.dot(pose.linear() * b->topology().triangle_normals[start_b.value]) >= 0.0) {
        continue;
      }
      ++starts;
      const WitnessRefinement refined = refineWitness(*a, *b, pose, start_a, start_b, workspace);
      EXPECT_NEAR(std::sqrt(refined.witness.squared_distance), std::sqrt(exact.squared_distance),
                  4.0 * kTriangleDistanceError);
    }
    EXPECT_GT(starts, 0);
  }
}

TEST(RefineWitness, TheClosestPairIsItsOwnRefinement) {
  RandomEngine engine(3);
  RefinementWorkspace workspace;
  for (std::uint32_t round = 0; round < 60; ++round) {
    const auto a = makeBody(test::concaveShape(round));
    const auto b = makeBody(test::concaveShape(round / 6));
    const Isometry3d pose = test::randomPose(engine, 2.0);
    const WitnessPair exact = test::enumerateTrianglePairs(*a, *b, pose);
    const WitnessRefinement refined =
        refineWitness(*a, *b, pose, exact.triangle_a, exact.triangle_b, workspace);
    EXPECT_TRUE(refined.proven);
    EXPECT_EQ(refined.iterations, 1U);
    EXPECT_NEAR(std::sqrt(refined.witness.squared_distance), std::sqrt(exact.squared_distance),
                4.0 * kTriangleDistanceError);
  }
}

TEST(RefineWitness, ShiftingABodyInItsOwnFrameCostsNoMoreThanThePosesRounding) {
  RandomEngine engine(4);
  RefinementWorkspace workspace;
  const SurfaceMesh comb = test::makeComb(3);
  const SurfaceMesh hook = test::makeHook();
  const auto shifted = [](const SurfaceMesh& mesh, const Vector3d& by) {
    std::vector<Vector3d> vertices = mesh.vertices();
    for (Vector3d& v : vertices) {
      v += by;
    }
    return SurfaceMesh(vertices, mesh.triangles(), "shifted");
  };
  // Multiples of 2^-20 keep every sum exact up to 2^32: only the kernel's own rounding may show.
  const auto snapped = [](const SurfaceMesh& mesh) {
    std::vector<Vector3d> vertices = mesh.vertices();
    for (Vector3d& v : vertices) {
      v = (v * 0x1p20).array().round() * 0x1p-20;
    }
    return SurfaceMesh(vertices, mesh.triangles(), "snapped");
  };
  const Vector3d far(1048576.0, -2097152.0, 524288.0);
  const auto a = makeBody(snapped(comb));
  const auto b = makeBody(snapped(hook));
  const auto far_a = makeBody(shifted(snapped(comb), far));
  const auto far_b = makeBody(shifted(snapped(hook), -far));
  for (int i = 0; i < 20; ++i) {
    const Isometry3d pose =
        test::translation((test::uniformInCube(engine, 1.5) * 0x1p20).array().round() * 0x1p-20);
    const Isometry3d far_pose = test::translation(pose.translation() + 2.0 * far);
    const TriangleIndex start_a{uniformIndex(engine, static_cast<std::uint32_t>(comb.triangleCount()))};
    const TriangleIndex start_b{uniformIndex(engine, static_cast<std::uint32_t>(hook.triangleCount()))};
    const WitnessRefinement near = refineWitness(*a, *b, pose, start_a, start_b, workspace);
    const WitnessRefinement away = refineWitness(*far_a, *far_b, far_pose, start_a, start_b, workspace);
    EXPECT_EQ(near.witness.squared_distance, away.witness.squared_distance);
    EXPECT_EQ(near.witness.triangle_a, away.witness.triangle_a);
    EXPECT_EQ(near.witness.triangle_b, away.witness.triangle_b);
  }
}

/// Every triangle split in three at a point within `height` of the middle of its first edge: one is a cap.
SurfaceMesh withCaps(const SurfaceMesh& mesh, double height) {
  std::vector<Vector3d> vertices = mesh.vertices();
  std::vector<TriangleNodes> triangles;
  for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
    const TriangleIndex triangle{t};
    const TriangleNodes nodes = mesh.triangle(triangle);
    const Vector3d middle = 0.5 * (mesh.corner(triangle, 0) + mesh.corner(triangle, 1));
    const Vector3d inwards = (mesh.corner(triangle, 2) - middle).normalized();
    const NodeIndex added{vertices.size()};
    vertices.emplace_back(middle + height * inwards);
    for (std::size_t k = 0; k < 3; ++k) {
      triangles.push_back({nodes[k], nodes[(k + 1) % 3], added});
    }
  }
  return SurfaceMesh(vertices, triangles, "mesh with caps");
}

TEST(RefineWitness, CapsAndNeedlesHideNoWayDown) {
  RandomEngine engine(6);
  RefinementWorkspace workspace;
  for (const double height : {1e-3, 1e-6, 1e-9, 1e-12, 1e-13, 3e-14, 1e-14, 3e-15, 1e-15, 1e-16, 1e-17}) {
    for (std::uint32_t round = 0; round < 6; ++round) {
      const auto a = makeBody(withCaps(test::concaveShape(round), height));
      const auto b = makeBody(withCaps(withCaps(test::concaveShape(round + 1), 0.03), height));
      const Isometry3d pose = test::randomPose(engine, 1.5);
      for (int start = 0; start < 100; ++start) {
        const TriangleIndex start_a{
            uniformIndex(engine, static_cast<std::uint32_t>(a->surface().triangleCount()))};
        const TriangleIndex start_b{
            uniformIndex(engine, static_cast<std::uint32_t>(b->surface().triangleCount()))};
        const WitnessRefinement refined = refineWitness(*a, *b, pose, start_a, start_b, workspace);
        ASSERT_TRUE(refined.proven);
        SCOPED_TRACE("caps " + std::to_string(height * 1e15) + " fm high, round " + std::to_string(round));
        expectLocalMinimum(*a, *b, pose, refined.witness);
      }
    }
  }
}

TEST(RefineWitness, SeesEveryPageOfABook) {
  // Three pages at one edge; only the third, which no triangle names as its neighbour, leads down.
  const SurfaceMesh book = test::makeSurface(
      {{0, 0, 0}, {1, 0, 0}, {0.5, 1, -1}, {0.5, -1, -1}, {0.5, 0.1, 1}}, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}});
  const auto a = makeBody(book);
  const auto b = makeBody(test::makeSurface({{0.5, 0, 5}, {0.4, 0, 6}, {0.6, 0.1, 6}}, {{0, 1, 2}}));
  RefinementWorkspace workspace;
  for (const std::uint32_t start : {0U, 1U, 2U}) {
    const WitnessRefinement refined =
        refineWitness(*a, *b, Isometry3d::Identity(), TriangleIndex{start}, TriangleIndex{0}, workspace);
    EXPECT_EQ(refined.witness.triangle_a, TriangleIndex{2});
    EXPECT_NEAR(refined.witness.squared_distance, 16.01, 1e-12);
  }
}

TEST(RefineWitness, ReturnsAtOnceWhereTrianglesMeet) {
  const auto a = makeBody(test::makeCuboid(Vector3d::Zero(), Vector3d::Ones()));
  const auto b = makeBody(test::makeCuboid(Vector3d::Constant(-0.25), Vector3d::Constant(0.25)));
  RefinementWorkspace workspace;
  const WitnessPair meeting = test::enumerateTrianglePairs(*a, *b, Isometry3d::Identity());
  EXPECT_EQ(meeting.squared_distance, 0.0);
  const WitnessRefinement refined =
      refineWitness(*a, *b, Isometry3d::Identity(), meeting.triangle_a, meeting.triangle_b, workspace);
  EXPECT_TRUE(refined.proven);
  EXPECT_EQ(refined.iterations, 1U);
  EXPECT_EQ(refined.triangles_opened, 0U);
  EXPECT_EQ(refined.witness.point_a_in_a, refined.witness.point_b_in_a);
}

TEST(RefineWitness, TouchingUpToRoundingIsTouching) {
  // Boxes face to face, turned together: the true distance is 0, the rounded corners leave up to 1e-16.
  const auto a = makeBody(test::makeCuboid(Vector3d::Zero(), Vector3d::Ones()));
  RandomEngine engine(7);
  RefinementWorkspace workspace;
  for (int i = 0; i < 50; ++i) {
    const Isometry3d world_from_a = test::randomPose(engine, 1.0);
    const Isometry3d pose =
        world_from_a.inverse(Eigen::Isometry) * (world_from_a * test::translation(Vector3d(0.3, 0.2, 1.0)));
    const WitnessPair closest = test::enumerateTrianglePairs(*a, *a, pose);
    const WitnessPair refined =
        refineWitness(*a, *a, pose, closest.triangle_a, closest.triangle_b, workspace).witness;
    EXPECT_EQ(refined.squared_distance, 0.0);
    EXPECT_EQ(refined.point_a_in_a, refined.point_b_in_a);
  }
}

TEST(RefineWitness, DescendsAcrossAFineMeshAllTheWay) {
  // From the far end of a wavy sheet to the crest: hundreds of triangles, no detour over nodes.
  const auto a = makeBody(test::makeSheet(80, 4, 0.01, 0.0));
  const auto b =
      makeBody(test::makeSurface({{0.81, 0.02, 0.5}, {0.9, 0.02, 0.6}, {0.9, 0.03, 0.6}}, {{0, 1, 2}}));
  RefinementWorkspace workspace;
  const WitnessRefinement refined =
      refineWitness(*a, *b, Isometry3d::Identity(), TriangleIndex{0}, TriangleIndex{0}, workspace);
  EXPECT_TRUE(refined.proven);
  EXPECT_NEAR(std::sqrt(refined.witness.squared_distance), std::hypot(0.5, 0.01),
              4.0 * kTriangleDistanceError);
  EXPECT_LT(refined.iterations, 200U);
}

}  // namespace
}  // namespace concave_distance::witness_refinement_test
