#include "thesis/src/continuous/build_constraint_tree.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

#include "concave_distance/base/error.h"
#include "mesh/surface/mesh_topology.h"
#include "mesh/trees/triangle_tree.h"
#include "support/concave_shapes.h"
#include "support/enumeration.h"
#include "support/plain_shapes.h"
#include "support/thesis_scenes.h"
#include "thesis/src/continuous/constraint_tree_file.h"
#include "thesis/src/continuous/continuous_genetic_search.h"
#include "thesis/test/continuous/tree_checks.h"

namespace concave_distance::build_constraint_tree_test {
namespace {

SurfaceMesh loadMesh(const std::string& file) {
  const std::string path = std::string(CONCAVE_DISTANCE_SOURCE_DIR) + "/meshes/" + file;
  return repairMesh(importMesh(path), {}, path).mesh;
}

/// Against containsPoint, which casts rays. Planes of the tree are off by flatness_tolerance times the
/// diagonal at most; ten times that decides which points are too close to the surface to compare.
void expectSameInside(const SurfaceMesh& mesh, const ConstraintTree& tree, const std::string& name) {
  const MeshTopology topology = buildMeshTopology(mesh);
  const TriangleTree rays(mesh);
  const double near = 10.0 * TreeBuildOptions{}.flatness_tolerance * mesh.diameter();
  const auto is_inside = [&](const Eigen::Vector3d& p) {
    return containsPoint(rays, mesh, topology.shell_is_closed, topology.shell_of_triangle, p);
  };
  const auto is_near = [&](const Eigen::Vector3d& p) {
    const bool here = is_inside(p);
    for (int axis = 0; axis < 3; ++axis) {
      for (const double step : {-near, near}) {
        if (is_inside(p + step * Eigen::Vector3d::Unit(axis)) != here) return true;
      }
    }
    return false;
  };
  const test::InsideComparison compared = test::compareInside(tree, 2500, 11, is_inside, is_near);
  EXPECT_EQ(compared.wrong, 0) << name << ", first at " << compared.first_wrong.transpose();
  EXPECT_GT(compared.compared, 2400) << name;
  EXPECT_GT(compared.inside, 100) << name;
}

struct Expected {
  std::map<int, std::pair<int, int>> levels;  ///< pieces and constraints of each
  std::size_t fallbacks;
};

class ThesisBody : public ::testing::TestWithParam<std::pair<const char*, Expected>> {};

TEST_P(ThesisBody, HasTheTreeOfTheDocumentationAndTheInsideOfItsMesh) {
  const auto& [name, expected] = GetParam();
  const SurfaceMesh mesh = loadMesh("thesis/" + std::string(name) + ".stl");
  const BuiltTree built = buildConstraintTree(mesh, {}, name);
  std::map<int, std::pair<int, int>> levels;
  for (const TreePiece& piece : built.tree.pieces()) {
    ++levels[piece.level].first;
    levels[piece.level].second += static_cast<int>(piece.constraint_count);
  }
  EXPECT_EQ(levels, expected.levels) << built.report.summary();
  EXPECT_EQ(built.report.fallbacks.size(), expected.fallbacks);
  EXPECT_EQ(built.report.dropped_pieces, 0u);
  expectSameInside(mesh, built.tree, name);
}

// The table of thesis/doc/continuous.md.
INSTANTIATE_TEST_SUITE_P(
    All, ThesisBody,
    ::testing::Values(std::pair("box", Expected{{{1, {1, 6}}}, 0}),
                      std::pair("notched_box", Expected{{{1, {1, 6}}, {-2, {2, 4}}}, 0}),
                      std::pair("semi_extruded", Expected{{{1, {1, 8}}, {-2, {5, 14}}}, 0}),
                      std::pair("grooved_cylinder", Expected{{{1, {1, 18}}, {-2, {1, 2}}, {3, {2, 34}}}, 1}),
                      std::pair("battery", Expected{{{1, {1, 14}}, {-2, {4, 14}}, {3, {2, 8}}}, 0}),
                      std::pair("fixture", Expected{{{1, {1, 26}}, {-2, {1, 1}}, {3, {8, 68}}}, 0})));

TEST(BuildConstraintTree, GivesTheTreesThatAreKeptForBuildsWithoutCgal) {
  for (const char* name : {"box", "notched_box", "semi_extruded", "grooved_cylinder", "battery", "fixture"}) {
    const ConstraintTree kept =
        readConstraintTreeFile(test::thesisFile("trees/" + std::string(name) + ".yaml"));
    const SurfaceMesh mesh = loadMesh("thesis/" + std::string(name) + ".stl");
    const ConstraintTree built = buildConstraintTree(mesh, {}, name).tree;
    EXPECT_EQ(kept.pieces().size(), built.pieces().size()) << name;
    EXPECT_EQ(kept.constraints().size(), built.constraints().size()) << name;
    expectSameInside(mesh, kept, name);
  }
}

TEST(BuildConstraintTree, HoldsForLinksOfRobots) {
  for (const char* name :
       {"wam/wam1_collision.stl", "wam/wam3_collision.stl", "wam/wam4_collision.stl",
        "wam/wam5_collision.stl", "wam/wam6_collision.stl", "wam/wam7_collision.stl", "kr5/wrist.stl"}) {
    const SurfaceMesh mesh = loadMesh(name);
    expectSameInside(mesh, buildConstraintTree(mesh, {}, name).tree, name);
  }
}

TEST(BuildConstraintTree, HoldsForExtrudedConcaveOutlines) {
  for (const auto& [name, mesh] : std::initializer_list<std::pair<const char*, SurfaceMesh>>{
           {"comb", test::makeComb(5)}, {"stairs", test::makeStairs(6)}, {"hook", test::makeHook()}}) {
    expectSameInside(mesh, buildConstraintTree(mesh, {}, name).tree, name);
  }
}

TEST(BuildConstraintTree, HoldsForARing) {
  // Neither hull minus ring nor what is left of that ends: a hole whose hull is no hull's smaller one.
  const SurfaceMesh mesh = test::makeRing(1.0, 0.3, 8, 5);
  expectSameInside(mesh, buildConstraintTree(mesh, {}, "ring").tree, "ring");
}

TEST(BuildConstraintTree, HoldsForCavitiesAndForBodiesOfSeveralShells) {
  const SurfaceMesh outer = test::makeCuboid({0, 0, 0}, {4, 4, 4});
  const SurfaceMesh hollow =
      test::makeJoined(outer, test::makeTurned(test::makeCuboid({1, 1, 1}, {3, 2, 3})));
  expectSameInside(hollow, buildConstraintTree(hollow, {}, "hollow").tree, "hollow");
  const SurfaceMesh two = test::makeJoined(outer, test::makeCuboid({5, 1, 1}, {6, 2, 3}));
  expectSameInside(two, buildConstraintTree(two, {}, "two").tree, "two");
}

TEST(BuildConstraintTree, ReportsWhereTheRecursionWouldGoOnForEver) {
  const BuiltTree built = buildConstraintTree(loadMesh("thesis/grooved_cylinder.stl"), {}, "cylinder");
  ASSERT_EQ(built.report.fallbacks.size(), 1u);
  const TreeFallback& fallback = built.report.fallbacks.front();
  EXPECT_EQ(fallback.reason, TreeFallback::Reason::Stagnation);
  EXPECT_EQ(fallback.level, 3);
  EXPECT_EQ(fallback.parts, 2u);  // two frusta, waist to waist
  EXPECT_NE(built.report.summary().find("2 convex pieces at level 3"), std::string::npos);
}

TEST(BuildConstraintTree, StopsAtTheDepthLimit) {
  TreeBuildOptions shallow;
  shallow.depth_limit = 2;
  const SurfaceMesh mesh = loadMesh("thesis/battery.stl");
  const BuiltTree built = buildConstraintTree(mesh, shallow, "battery");
  EXPECT_GT(built.report.fallbacks.size(), 0u);
  for (const TreeFallback& fallback : built.report.fallbacks) {
    EXPECT_EQ(fallback.reason, TreeFallback::Reason::DepthLimit);
  }
  for (const TreePiece& piece : built.tree.pieces()) EXPECT_LE(std::abs(piece.level), 2);
  expectSameInside(mesh, built.tree, "battery, two levels");
}

TEST(BuildConstraintTree, PartsOfACutPieceLeaveNoFeasibleSheetBetweenThem) {
  TreeBuildOptions shallow;
  shallow.depth_limit = 2;
  const SurfaceMesh mesh = test::makeHook();  // its bow is one concavity; two levels cut it where it bends
  const ConstraintTree tree = buildConstraintTree(mesh, shallow, "hook").tree;
  RandomEngine engine(12);
  // Points on every plane of every concavity, inside the bow: the planes of cuts are among them.
  for (const LinearConstraint& constraint : tree.constraints()) {
    for (int i = 0; i < 200; ++i) {
      Eigen::Vector3d p(test::uniformIn(engine, 0.1, 0.35), test::uniformIn(engine, 0.1, 0.35),
                        test::uniformIn(engine, -0.05, 0.05));
      p -= constraint.value(p) * constraint.normal;
      const bool in_bow =
          p.x() > 0.101 && p.x() < 0.349 && p.y() > 0.101 && std::abs(p.z()) < 0.049 && p.y() < 0.3;
      EXPECT_TRUE(!in_bow || !evaluatePoint(tree, p).is_feasible) << p.transpose();
    }
  }
}

TEST(BuildConstraintTree, LeavesOutWhatIsThinnerThanTheTolerance) {
  std::vector<Eigen::Vector3d> vertices = test::makeCuboid({0, 0, 0}, {1, 1, 1}).vertices();
  vertices[7].z() -= 1e-5;  // a dent along the top's diagonal
  const SurfaceMesh bent(vertices, test::makeCuboid({0, 0, 0}, {1, 1, 1}).triangles(), "bent");
  TreeBuildOptions coarse;
  coarse.flatness_tolerance = 1e-4;
  EXPECT_EQ(buildConstraintTree(bent, coarse, "bent").tree.constraints().size(), 6u);
}

TEST(BuildConstraintTree, RefusesSurfacesWithoutAnInside) {
  const SurfaceMesh cube = test::makeCuboid({0, 0, 0}, {1, 1, 1});
  EXPECT_THROW(buildConstraintTree(test::makeOpened(cube, 3), {}, "open"), Error);
  EXPECT_THROW(buildConstraintTree(test::makeTurned(cube), {}, "turned inside out"), Error);
  std::vector<Eigen::Vector3d> pulled = test::makeHook().vertices();
  pulled[3] += Eigen::Vector3d(-1.0, 0, 0);
  const SurfaceMesh crossing(pulled, test::makeHook().triangles(), "crossing");
  EXPECT_THROW(buildConstraintTree(crossing, {}, "crossing"), Error);
  TreeBuildOptions wrong;
  wrong.flatness_tolerance = 0.0;
  EXPECT_THROW(buildConstraintTree(cube, wrong, "tolerance"), Error);
}

TEST(ContinuousGeneticSearch, SolvesTheBatteryAndFixtureInMoreThanHalfOfTheRuns) {
  const test::ThesisScene s = test::loadThesisScene("battery_static", 10.0);
  const double minimum = std::sqrt(test::enumerateTrianglePairs(*s.a, *s.b, s.a_from_b).squared_distance);
  const ConstraintTree a = buildConstraintTree(s.a->surface(), {}, "fixture").tree;
  const ConstraintTree b = buildConstraintTree(s.b->surface(), {}, "battery").tree;
  constexpr int kRuns = 20;
  int solved = 0;
  for (int seed = 0; seed < kRuns; ++seed) {
    RandomEngine engine(static_cast<std::uint64_t>(seed));
    const ContinuousResult result =
        continuousGeneticSearch(a, b, s.a_from_b, improvedContinuousGenetic(), engine);
    // The second minimum, 0.1336, lies beyond 1.1 d*.
    solved += result.is_feasible && result.distance < 1.1 * minimum ? 1 : 0;
    EXPECT_TRUE(!result.is_feasible || result.distance > minimum - 1e-6) << "no feasible pair is nearer";
  }
  EXPECT_GT(solved, kRuns / 2);
}

}  // namespace
}  // namespace concave_distance::build_constraint_tree_test
