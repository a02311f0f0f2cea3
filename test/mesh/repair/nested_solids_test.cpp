#include <gtest/gtest.h>

#include "concave_distance/mesh/repair/repair_mesh.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "support/mesh_measures.h"
#include "support/painted_boxes.h"

/// Solids and cavities within others, by the thousands.
namespace concave_distance::nested_solids_test {
namespace {

using Eigen::Vector3d;
using test::Box;

RepairedMesh repairedNest(const TriangleSoup& soup) {
  return repairMesh(soup, RepairOptions(), "nested solids");
}

/// Cubes around the origin from the outside to the inside, every other one wound as a cavity.
TriangleSoup nestedCubes(int count, double angle) {
  TriangleSoup soup;
  for (int i = 0; i < count; ++i) {
    const Vector3d half = Vector3d::Constant(1.0 + 0.001 * (count - i));
    test::addBox(soup, Box(-half, half), 0, i % 2 != 0);
  }
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  for (Vector3d& vertex : soup.vertices) vertex = turn * vertex;
  return soup;
}

TEST(NestedSolids, ThousandsOfCavitiesInAFineSkinTakeSeconds) {
  TriangleSoup soup;
  const SurfaceMesh skin = makeSphere(30.0, 5e-4, "skin");
  ASSERT_GT(skin.triangleCount(), 100'000U);
  soup.vertices = skin.vertices();
  for (const TriangleNodes& t : skin.triangles())
    soup.triangles.push_back({t[0].value, t[1].value, t[2].value});
  std::size_t cavities = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Vector3d low = Vector3d(i % 28, i / 28 % 28, i / 784) - Vector3d::Constant(13.5);
    cavities += i % 3 != 0 ? 1U : 0U;
    test::addBox(soup, Box(low, low + Vector3d::Constant(0.5)), 0, i % 3 != 0);
  }
  const RepairedMesh repaired = repairedNest(soup);
  EXPECT_EQ(repaired.report.closed_shells, 20'001U);
  EXPECT_EQ(repaired.report.turned_triangles, 0U);
}

TEST(NestedSolids, TwoThousandWithinOneAnotherAreSolidsAndCavitiesByTurns) {
  const RepairedMesh repaired = repairedNest(nestedCubes(2'000, 0.0));
  EXPECT_EQ(repaired.report.closed_shells, 2'000U);
  EXPECT_EQ(repaired.report.turned_triangles, 0U);
}

TEST(NestedSolids, OfTooManyWithinOneAnotherTheInnermostAreSolids) {
  // At this angle the bounding boxes meet each other's surfaces, which takes the most work.
  const RepairedMesh repaired = repairedNest(nestedCubes(5'000, 0.4));
  EXPECT_EQ(repaired.report.closed_shells, 5'000U);
  const auto volume_of = [&](std::size_t cube) {
    double sum = 0.0;
    for (std::size_t t = 12 * cube; t < 12 * cube + 12; ++t) {
      const TriangleIndex triangle{t};
      sum += repaired.mesh.corner(triangle, 0)
                 .dot(repaired.mesh.corner(triangle, 1).cross(repaired.mesh.corner(triangle, 2)));
    }
    return sum;
  };
  for (const std::size_t cube : {1U, 999U}) EXPECT_LT(volume_of(cube), 0.0) << cube;
  for (const std::size_t cube : {0U, 998U, 4'998U, 4'999U}) EXPECT_GT(volume_of(cube), 0.0) << cube;
}

TEST(NestedSolids, ACavityMayTouchTheSkinFromInside) {
  for (const double scale : {0.1, 1.0, 700.0 / 3.0}) {
    for (const double angle : {0.0, 0.3}) {
      TriangleSoup soup;
      test::addBox(soup, Box(Vector3d(0, 0, 0), Vector3d(4, 4, 4)), 0, false);
      test::addBox(soup, Box(Vector3d(1, 1.5, 2), Vector3d(2, 3, 4)), 63, true);
      const Eigen::Matrix3d turn =
          Eigen::AngleAxisd(angle, Vector3d(3, 2, 1).normalized()).toRotationMatrix();
      for (Vector3d& vertex : soup.vertices) vertex = turn * (scale * (vertex + Vector3d::Constant(0.1)));
      const RepairedMesh repaired = repairedNest(soup);
      EXPECT_EQ(repaired.report.turned_triangles, 0U) << "scale " << scale << ", angle " << angle;
    }
  }
}

}  // namespace
}  // namespace concave_distance::nested_solids_test
