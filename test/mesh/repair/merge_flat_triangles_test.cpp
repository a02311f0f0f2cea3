#include "mesh/repair/merge_flat_triangles.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "concave_distance/mesh/surface/primitives.h"
#include "mesh/surface/refine_mesh.h"
#include "support/case_seed.h"
#include "support/concave_shapes.h"
#include "support/mesh_measures.h"
#include "support/mesh_variants.h"
#include "support/plain_shapes.h"
#include "support/random_solids.h"

namespace concave_distance::merge_flat_triangles_test {
namespace {

constexpr double kRounding = 1e-12;  // metres, of bodies a metre across

SurfaceMesh refined(const SurfaceMesh& mesh, double max_edge_length) {
  return refineToEdgeLength(mesh, max_edge_length).mesh;
}

SurfaceMesh merged(const SurfaceMesh& mesh) {
  return mergeFlatTriangles(mesh, kMergeTolerance * mesh.diameter()).mesh;
}

SurfaceMesh welded(const SurfaceMesh& mesh) {
  TriangleSoup soup;
  soup.vertices = mesh.vertices();
  for (const TriangleNodes& t : mesh.triangles())
    soup.triangles.push_back({t[0].value, t[1].value, t[2].value});
  return weldEqualVertices(soup, "welded");
}

Eigen::Vector3d randomPointOn(const SurfaceMesh& mesh, RandomEngine& engine) {
  const TriangleIndex t{uniformIndex(engine, static_cast<std::uint32_t>(mesh.triangleCount()))};
  const double u = uniformUnit(engine);
  const double v = uniformUnit(engine) * (1.0 - u);
  return (1.0 - u - v) * mesh.corner(t, 0) + u * mesh.corner(t, 1) + v * mesh.corner(t, 2);
}

/// Of points drawn on each surface, the farthest from the other.
double apart(const SurfaceMesh& a, const SurfaceMesh& b, RandomEngine& engine, int draws = 300) {
  double farthest = 0.0;
  for (int i = 0; i < draws; ++i) {
    farthest = std::max({farthest, test::distanceToSurface(randomPointOn(a, engine), b),
                         test::distanceToSurface(randomPointOn(b, engine), a)});
  }
  return farthest;
}

/// Of a node from the inside of an edge that it does not belong to.
double leastNodeToEdge(const SurfaceMesh& mesh) {
  double least = mesh.diameter();
  for (const auto& [edge, use] : test::edgeUses(mesh)) {
    const Eigen::Vector3d& a = mesh.vertex(NodeIndex{edge.first});
    const Eigen::Vector3d along = mesh.vertex(NodeIndex{edge.second}) - a;
    for (std::uint32_t i = 0; i < mesh.vertexCount(); ++i) {
      if (i == edge.first || i == edge.second) continue;
      const Eigen::Vector3d to_node = mesh.vertex(NodeIndex{i}) - a;
      const double s = std::clamp(to_node.dot(along) / along.squaredNorm(), 0.0, 1.0);
      least = std::min(least, (to_node - s * along).norm());
    }
  }
  return least;
}

void expectSameSurface(const SurfaceMesh& before, const SurfaceMesh& after, double tolerance = kRounding) {
  RandomEngine engine(test::caseSeed(17));
  EXPECT_LE(apart(before, after, engine), tolerance);
  EXPECT_NEAR(test::totalArea(after), test::totalArea(before), 1e-9 + 10.0 * tolerance);
  EXPECT_NEAR(test::signedVolume(after), test::signedVolume(before), 1e-9 + 10.0 * tolerance);
  EXPECT_EQ(test::eulerCharacteristic(after), test::eulerCharacteristic(before));
}

TEST(MergeFlatTriangles, ARefinedCubeIsTwelveTrianglesAgain) {
  const Eigen::Isometry3d pose = Eigen::Translation3d(0.3, -0.2, 0.7) *
                                 Eigen::AngleAxisd(1.1, Eigen::Vector3d(1.0, 2.0, 3.0).normalized());
  for (const SurfaceMesh& cube : {makeBox({1, 1, 1}), test::movedSurface(makeBox({1, 1, 1}), pose)}) {
    const SurfaceMesh fine = refined(cube, 0.1);
    const SurfaceMesh coarse = merged(fine);
    EXPECT_GT(fine.triangleCount(), 1000U);
    EXPECT_EQ(coarse.triangleCount(), 12U);
    EXPECT_EQ(coarse.vertexCount(), 8U);
    EXPECT_TRUE(test::isClosedManifold(coarse));
    expectSameSurface(fine, coarse);
  }
}

TEST(MergeFlatTriangles, APrismNeedsFourTrianglesForEachCornerOfItsOutlineLessFour) {
  for (const SurfaceMesh& prism :
       {test::makeComb(5), test::makeStairs(4), test::makeLShape(), test::makeHook()}) {
    const SurfaceMesh fine = refined(prism, 0.06);
    const SurfaceMesh coarse = merged(fine);
    EXPECT_EQ(coarse.triangleCount(), 4 * (coarse.vertexCount() / 2) - 4);
    EXPECT_EQ(coarse.triangleCount(), prism.triangleCount());
    EXPECT_TRUE(test::isClosedManifold(coarse));
    EXPECT_GT(leastNodeToEdge(coarse), 1e-3);
    expectSameSurface(fine, coarse);
  }
}

TEST(MergeFlatTriangles, AFaceWithAHoleNeedsAsManyTrianglesAsCorners) {
  for (const std::uint32_t around : {4U, 7U, 24U}) {
    const SurfaceMesh fine = refined(test::makePlateWithHole(0.5, 0.2, 0.1, around), 0.05);
    const SurfaceMesh coarse = merged(fine);
    // Two faces of 2 n corners and one hole, 2 n sides of two triangles.
    EXPECT_EQ(coarse.triangleCount(), 2 * (2 * around + 2 - 2) + 4 * around);
    EXPECT_TRUE(test::isClosedManifold(coarse));
    EXPECT_GT(leastNodeToEdge(coarse), 1e-3);
    expectSameSurface(fine, coarse);
  }
}

TEST(MergeFlatTriangles, AFlatSheetIsTwoTrianglesAndAWavySheetStays) {
  const SurfaceMesh sheet = test::makeSheet(9, 7);
  const SurfaceMesh coarse = merged(sheet);
  EXPECT_EQ(coarse.triangleCount(), 2U);
  expectSameSurface(sheet, coarse);
  const SurfaceMesh wavy = test::makeSheet(9, 7, 0.1, 0.05);
  EXPECT_EQ(merged(wavy).triangleCount(), wavy.triangleCount());
}

TEST(MergeFlatTriangles, ShellsAndCavitiesAreMergedOnTheirOwn) {
  const SurfaceMesh block = refined(test::makeCuboid({0, 0, 0}, {1, 1, 1}), 0.2);
  const SurfaceMesh cavity =
      refined(test::makeTurned(test::makeCuboid({0.2, 0.2, 0.2}, {0.4, 0.5, 0.6})), 0.1);
  const SurfaceMesh beside = refined(test::makeCuboid({2, 0, 0}, {3, 1, 1}), 0.3);
  const SurfaceMesh fine = test::makeJoined(test::makeJoined(block, cavity), beside);
  const SurfaceMesh coarse = merged(fine);
  EXPECT_EQ(coarse.triangleCount(), 36U);
  EXPECT_TRUE(test::isClosedManifold(coarse));
  expectSameSurface(fine, coarse);
}

TEST(MergeFlatTriangles, AnEdgeOfSeveralTrianglesLosesItsNodesInAllOfThem) {
  const SurfaceMesh cubes = welded(
      test::makeJoined(test::makeCuboid({0, 0, 0}, {1, 1, 1}), test::makeCuboid({1, 1, 0}, {2, 2, 1})));
  const SurfaceMesh fin = test::makeSurface(
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 1, 1}, {0, 1, 1}, {0, 2, 0.5}, {1, 2, 0.5}},
      {{0, 1, 2}, {0, 2, 3}, {3, 2, 4}, {3, 4, 5}, {3, 2, 7}, {3, 7, 6}});
  for (const SurfaceMesh& mesh : {cubes, fin}) {
    const SurfaceMesh fine = refined(mesh, 0.3);
    const SurfaceMesh coarse = merged(fine);
    EXPECT_EQ(coarse.triangleCount(), mesh.triangleCount());
    const auto before = test::unpairedLength(fine);
    const auto after = test::unpairedLength(coarse);
    ASSERT_EQ(after.size(), before.size());
    for (const auto& [use, length] : before) EXPECT_NEAR(after.at(use), length, kRounding);
    expectSameSurface(fine, coarse);
  }
}

TEST(MergeFlatTriangles, TwoSidesOfASheetDoNotGetTheSameDiagonal) {
  std::vector<Eigen::Vector3d> vertices{{1, 1, 0}, {1, 1, 0},  // the middle, above and below
                                        {0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0},
                                        {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}};
  std::vector<TriangleNodes> triangles;
  for (std::uint32_t i = 0; i < 8; ++i) {
    const NodeIndex a{2 + i};
    const NodeIndex b{2 + (i + 1) % 8};
    triangles.push_back({NodeIndex{0}, a, b});
    triangles.push_back({NodeIndex{1}, b, a});
  }
  const SurfaceMesh coarse = merged(SurfaceMesh(vertices, triangles, "pillow"));
  EXPECT_EQ(coarse.triangleCount(), 4U);
  EXPECT_TRUE(test::isClosedManifold(coarse));
}

TEST(MergeFlatTriangles, RoughFacesMoveByNoMoreThanTheTolerance) {
  RandomEngine engine(test::caseSeed(3));
  for (const double noise : {1e-9, 1e-5, 1e-3}) {
    const SurfaceMesh fine = refined(test::makeLShape(), 0.08);
    std::vector<Eigen::Vector3d> vertices = fine.vertices();
    for (Eigen::Vector3d& v : vertices) v += test::uniformInCube(engine, noise);
    const SurfaceMesh rough(vertices, fine.triangles(), "rough");
    for (const double tolerance : {2e-7, 1e-4, 1e-2}) {
      const SurfaceMesh coarse = mergeFlatTriangles(rough, tolerance).mesh;
      EXPECT_TRUE(test::isClosedManifold(coarse));
      expectSameSurface(rough, coarse, tolerance);
      if (10.0 * noise < tolerance) {
        EXPECT_EQ(coarse.triangleCount(), test::makeLShape().triangleCount()) << noise << ' ' << tolerance;
      }
    }
  }
}

TEST(MergeFlatTriangles, RefiningAndMergingARandomSolidAddsNothing) {
  for (int i = 0; i < test::caseCount(12); ++i) {
    RandomEngine engine(test::caseSeed(100 + static_cast<std::uint64_t>(i)));
    const SurfaceMesh solid = test::randomSolid(engine);
    const SurfaceMesh fine = refined(solid, 0.12);
    const SurfaceMesh coarse = merged(fine);
    EXPECT_LE(coarse.triangleCount(), solid.triangleCount());
    EXPECT_TRUE(test::isClosedManifold(coarse));
    expectSameSurface(fine, coarse, 1e-6);
    EXPECT_EQ(merged(coarse).triangleCount(), coarse.triangleCount());
  }
}

TEST(MergeFlatTriangles, TrianglesOfOnePlaneArePartedByNoOtherPlane) {
  // A corner is moved: its three faces are two triangles each, bent by about the tolerance.
  for (const double bend : {1e-8, 1e-7, 3e-7, 1e-6}) {
    std::vector<Eigen::Vector3d> vertices = makeBox({1, 1, 1}).vertices();
    vertices.back() += Eigen::Vector3d::Constant(bend);
    const SurfaceMesh bent(vertices, makeBox({1, 1, 1}).triangles(), "bent");
    const SurfaceMesh fine = refined(bent, 0.07);
    const SurfaceMesh coarse = merged(fine);
    EXPECT_EQ(coarse.triangleCount(), 12U) << bend;
    expectSameSurface(fine, coarse, kMergeTolerance * fine.diameter());
  }
}

TEST(MergeFlatTriangles, WithoutAToleranceOnlyWhatIsExactlyFlatIsMerged) {
  const SurfaceMesh fine = refined(makeBox({1, 1, 1}), 0.2);
  EXPECT_EQ(mergeFlatTriangles(fine, 0.0).mesh.triangleCount(), 12U);
}

}  // namespace
}  // namespace concave_distance::merge_flat_triangles_test
