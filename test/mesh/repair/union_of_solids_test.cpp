#include <gtest/gtest.h>

#include <cmath>

#include "concave_distance/mesh/repair/repair_mesh.h"
#include "mesh/surface/mesh_topology.h"
#include "mesh/trees/triangle_tree.h"
#include "support/body_pairs.h"
#include "support/case_seed.h"
#include "support/mesh_measures.h"
#include "support/mesh_variants.h"
#include "support/painted_boxes.h"

/// Repair makes of a file's triangles the surface of the union of its solids, and the topology says what is
/// inside it.
namespace concave_distance::union_of_solids_test {
namespace {

using Eigen::Vector3d;
using test::Box;

RepairedMesh repair(const TriangleSoup& soup) {
  return repairMesh(soup, {}, "union");
}

class Inside {
 public:
  explicit Inside(SurfaceMesh surface)
      : surface_(std::move(surface)), topology_(buildMeshTopology(surface_)), tree_(surface_) {}
  bool operator()(const Vector3d& point) const {
    return containsPoint(tree_, surface_, topology_.shell_is_closed, topology_.shell_of_triangle, point);
  }
  const MeshTopology& topology() const { return topology_; }

 private:
  SurfaceMesh surface_;
  MeshTopology topology_;
  TriangleTree tree_;
};

std::size_t closedShells(const RepairedMesh& repaired) {
  return repaired.report.closed_shells;
}

Box boxAt(double x, double y, double z, double size = 1.0) {
  return Box(Vector3d(x, y, z), Vector3d(x, y, z) + Vector3d::Constant(size));
}

TEST(UnionOfSolids, AFaceThatTwoBoxesShareIsNoPartOfTheSurface) {
  TriangleSoup soup;
  test::addBox(soup, boxAt(0, 0, 0), 0, false);
  test::addBox(soup, boxAt(1, 0, 0), 0, false);
  const RepairedMesh repaired = repair(soup);
  EXPECT_EQ(repaired.report.inner_wall_triangles, 4U);
  EXPECT_EQ(repaired.report.duplicate_triangles, 0U);
  EXPECT_EQ(repaired.report.non_manifold_edges, 0U);
  EXPECT_EQ(repaired.report.shells, 1U);
  EXPECT_EQ(closedShells(repaired), 1U);
  EXPECT_TRUE(test::isClosedManifold(repaired.mesh));
  EXPECT_DOUBLE_EQ(test::signedVolume(repaired.mesh), 2.0);
  EXPECT_NE(repaired.report.summary().find("4 triangles between touching solids dropped"), std::string::npos);
}

TEST(UnionOfSolids, AnyNumberOfBoxesAroundAnEdgeAreOneSolid) {
  TriangleSoup soup;
  for (int i = 0; i < 4; ++i) {
    test::addBox(soup, boxAt(i % 2, i / 2, 0), 0x3f, i == 2);
    const RepairedMesh repaired = repair(soup);
    EXPECT_TRUE(test::isClosedManifold(repaired.mesh)) << i;
    EXPECT_DOUBLE_EQ(test::signedVolume(repaired.mesh), i + 1.0);
    EXPECT_EQ(closedShells(repaired), 1U);
  }
}

TEST(UnionOfSolids, BoxesThatShareAnEdgeOrACornerAreShellsOfTheirOwn) {
  for (const Vector3d& shift : {Vector3d(1, 1, 0), Vector3d(1, 1, 1)}) {
    TriangleSoup soup;
    test::addBox(soup, boxAt(0, 0, 0), 0, false);
    test::addBox(soup, boxAt(shift.x(), shift.y(), shift.z()), 0, true);
    const RepairedMesh repaired = repair(soup);
    EXPECT_EQ(repaired.report.shells, 2U);
    EXPECT_EQ(closedShells(repaired), 2U);
    EXPECT_DOUBLE_EQ(test::signedVolume(repaired.mesh), 2.0);
  }
}

TEST(UnionOfSolids, APartOfAFaceThatIsSharedGoes) {
  TriangleSoup slab;  // three by three, one solid
  for (int i = 0; i < 9; ++i) test::addBox(slab, boxAt(i % 3, i / 3, 0), 0, false);
  TriangleSoup soup = test::soupOf(repair(slab).mesh);
  ASSERT_EQ(soup.triangles.size(), 2U * (9 + 9 + 12));
  test::addBox(soup, boxAt(1, 1, 1), 0, false);
  const RepairedMesh repaired = repair(soup);
  EXPECT_EQ(repaired.report.inner_wall_triangles, 4U);
  EXPECT_TRUE(test::isClosedManifold(repaired.mesh));
  EXPECT_EQ(closedShells(repaired), 1U);
  EXPECT_DOUBLE_EQ(test::signedVolume(repaired.mesh), 10.0);
}

TEST(UnionOfSolids, AWallThatIsThereOnceOpensNothing) {
  TriangleSoup soup;
  test::addBox(soup, boxAt(0, 0, 0), 0, false);
  test::addBox(soup, boxAt(1, 0, 0), 0, false);
  for (std::size_t t = 12; t < soup.triangles.size();) {  // the second box's share of the wall
    bool in_wall = true;
    for (const std::uint32_t v : soup.triangles[t]) in_wall = in_wall && soup.vertices[v].x() == 1.0;
    if (in_wall) soup.triangles.erase(soup.triangles.begin() + static_cast<std::ptrdiff_t>(t));
    t += in_wall ? 0 : 1;
  }
  ASSERT_EQ(soup.triangles.size(), 22U);
  const RepairedMesh repaired = repair(soup);
  EXPECT_EQ(closedShells(repaired), 1U);
  EXPECT_EQ(repaired.report.shells, 2U) << "the wall is a sheet";
  const Inside inside(repaired.mesh);
  EXPECT_TRUE(inside({0.5, 0.4, 0.3}));
  EXPECT_TRUE(inside({1.5, 0.4, 0.3}));
}

TEST(UnionOfSolids, EverythingTwiceIsThereOnce) {
  for (const bool turned : {false, true}) {
    TriangleSoup soup;
    for (const bool second : {false, true}) {
      test::addBox(soup, boxAt(0, 0, 0), 0, second && turned);
      test::addBox(soup, boxAt(1, 0, 0), 0, second && turned);
    }
    const RepairedMesh repaired = repair(soup);
    EXPECT_EQ(repaired.report.duplicate_triangles, 20U);
    EXPECT_EQ(repaired.report.inner_wall_triangles, 8U);
    EXPECT_TRUE(test::isClosedManifold(repaired.mesh));
    EXPECT_DOUBLE_EQ(test::signedVolume(repaired.mesh), 2.0);
  }
}

TEST(UnionOfSolids, ASheetOfTwoSidesStaysASheet) {
  TriangleSoup soup;
  test::addRectangle(soup, Vector3d::Zero(), Vector3d::UnitX(), Vector3d::UnitY(), false);
  test::addRectangle(soup, Vector3d::Zero(), Vector3d::UnitY(), Vector3d::UnitX(), false);
  const RepairedMesh repaired = repair(soup);
  EXPECT_EQ(repaired.report.duplicate_triangles, 2U);
  EXPECT_EQ(repaired.mesh.triangleCount(), 2U);
  EXPECT_EQ(closedShells(repaired), 0U);
}

TEST(UnionOfSolids, ASheetWhoseSidesAreCutInDifferentWaysHasNoInside) {
  TriangleSoup soup;
  test::addRectangle(soup, Vector3d::Zero(), {1, 2, 3}, {-2, 1, 1}, false);
  test::addRectangle(soup, Vector3d::Zero(), {-2, 1, 1}, {1, 2, 3}, true);
  const RepairedMesh repaired = repair(soup);
  EXPECT_EQ(repaired.mesh.triangleCount(), 4U);
  EXPECT_EQ(closedShells(repaired), 0U);
}

TEST(UnionOfSolids, ASheetThatHangsOnASolidOpensNothing) {
  for (const bool two_sided : {false, true}) {
    for (const bool at_corner : {false, true}) {
      TriangleSoup soup;
      test::addBox(soup, boxAt(0, 0, 0), 0, true);
      const Vector3d b = at_corner ? Vector3d(2, 1, 2) : Vector3d(0, 0, 1);
      test::addTriangle(soup, {1, 1, 1}, b, {2, 2, 2});
      if (!at_corner) {
        soup.triangles.pop_back();
        test::addTriangle(soup, {1, 1, 1}, {1, 1, 0}, {2, 2, 0});
      }
      if (two_sided) {
        const auto t = soup.triangles.back();
        soup.triangles.push_back({t[1], t[0], t[2]});
      }
      const RepairedMesh repaired = repair(soup);
      EXPECT_EQ(repaired.report.shells, 2U);
      EXPECT_EQ(closedShells(repaired), 1U);
      EXPECT_EQ(repaired.mesh.triangleCount(), 13U);
      const Inside inside(repaired.mesh);
      EXPECT_TRUE(inside({0.5, 0.4, 0.3}));
      EXPECT_FALSE(inside({1.5, 0.9, 0.9}));
    }
  }
}

TEST(UnionOfSolids, WindingTellsACavityFromASolidWithinASolid) {
  for (const bool all_turned : {false, true}) {
    for (const bool cavity : {false, true}) {
      TriangleSoup soup;
      test::addBox(soup, boxAt(0, 0, 0, 4), 0, all_turned);
      test::addBox(soup, boxAt(1, 1, 1, 2), 0, all_turned != cavity);
      const RepairedMesh repaired = repair(soup);
      EXPECT_EQ(closedShells(repaired), 2U);
      EXPECT_EQ(repaired.report.turned_triangles, all_turned ? 24U : 0U);
      const Inside inside(repaired.mesh);
      EXPECT_TRUE(inside({0.5, 0.4, 0.3}));
      EXPECT_EQ(inside({2.1, 2.2, 2.3}), !cavity);
    }
  }
}

TEST(UnionOfSolids, AMembraneOverAnOpeningStaysOnBothSides) {
  // A cavity whose top is a part of the box's own top: a cup under a lid without thickness.
  TriangleSoup soup;
  for (int x = 0; x < 3; ++x) {
    for (int y = 0; y < 3; ++y) {
      test::addBox(soup, boxAt(x, y, 0), 0, false);
      if (x != 1 || y != 1) test::addBox(soup, boxAt(x, y, 1), 0, false);
    }
  }
  test::addRectangle(soup, {1, 1, 2}, Vector3d::UnitX(), Vector3d::UnitY(), false);
  test::addRectangle(soup, {1, 1, 2}, Vector3d::UnitY(), Vector3d::UnitX(), false);
  const RepairedMesh repaired = repair(soup);
  EXPECT_EQ(closedShells(repaired), 1U);
  const Inside inside(repaired.mesh);
  EXPECT_FALSE(inside({1.5, 1.4, 1.3}));
  EXPECT_TRUE(inside({1.5, 1.4, 0.3}));
  EXPECT_TRUE(inside({0.5, 1.4, 1.3}));
}

struct Drawn {
  test::PaintedBoxes painted;
  Eigen::Isometry3d pose;
  double scale;
  TriangleSoup soup;
};

Drawn draw(RandomEngine& engine) {
  Drawn drawn{test::randomUnion(engine), Eigen::Isometry3d::Identity(), 1.0, {}};
  drawn.scale = std::pow(10.0, test::uniformIn(engine, -3.0, 3.0));
  if (uniformIndex(engine, 4) != 0) drawn.pose = test::randomPose(engine, 10.0 * drawn.scale);
  drawn.soup = test::rewritten(drawn.painted.soup, drawn.pose, drawn.scale, engine);
  return drawn;
}

TEST(UnionOfSolids, ContainsExactlyTheMaterialOfEverySolid) {
  const std::uint64_t seed = test::caseSeed(1);
  const std::uint64_t cases = test::caseCount<std::uint64_t>(400);
  for (std::uint64_t i = 0; i < cases; ++i) {
    RandomEngine engine(streamSeed(seed, "union of solids", i));
    const Drawn drawn = draw(engine);
    const RepairedMesh repaired = repair(drawn.soup);
    const Inside inside(repaired.mesh);
    for (int k = 0; k < 40; ++k) {
      const Vector3d point = test::uniformInCube(engine, 2.0);
      ASSERT_EQ(inside(drawn.pose * Vector3d(drawn.scale * point)), test::isMaterial(drawn.painted, point))
          << "case " << i << " of seed " << seed << " at " << point.transpose();
    }
    for (const Box& cell : test::materialOf(drawn.painted)) {
      ASSERT_TRUE(inside(drawn.pose * Vector3d(drawn.scale * cell.center())))
          << "case " << i << " of seed " << seed << " at " << cell.center().transpose();
    }
  }
}

TEST(UnionOfSolids, ARepairedUnionStaysAsItIs) {
  const std::uint64_t seed = test::caseSeed(1);
  const std::uint64_t cases = test::caseCount<std::uint64_t>(200);
  for (std::uint64_t i = 0; i < cases; ++i) {
    RandomEngine engine(streamSeed(seed, "repaired union", i));
    const RepairedMesh once = repair(draw(engine).soup);
    const RepairedMesh twice = repair(test::soupOf(once.mesh));
    ASSERT_EQ(twice.mesh.triangles(), once.mesh.triangles()) << "case " << i << " of seed " << seed;
    ASSERT_EQ(twice.report.turned_triangles, 0U) << "case " << i << " of seed " << seed;
    ASSERT_EQ(twice.report.shells, once.report.shells);
    ASSERT_EQ(twice.report.closed_shells, once.report.closed_shells);
  }
}

}  // namespace
}  // namespace concave_distance::union_of_solids_test
