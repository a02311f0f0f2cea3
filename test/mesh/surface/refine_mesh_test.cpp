#include "mesh/surface/refine_mesh.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "concave_distance/base/error.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "support/any_surface.h"
#include "support/mesh_measures.h"

namespace concave_distance::refine_mesh_test {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

SurfaceMesh surfaceOf(std::vector<Eigen::Vector3d> vertices,
                      const std::vector<std::array<std::uint32_t, 3>>& corners) {
  std::vector<TriangleNodes> triangles;
  triangles.reserve(corners.size());
  for (const auto& c : corners) triangles.push_back({NodeIndex{c[0]}, NodeIndex{c[1]}, NodeIndex{c[2]}});
  return SurfaceMesh(std::move(vertices), std::move(triangles), "test surface");
}

using Vector3l = Eigen::Matrix<long double, 3, 1>;

// Bounds the error of test::distanceToTriangle in long double for a point in the triangle's plane. With u the
// unit of rounding and L the longest side, the normal n is off by at most 8 u L^2, and so is its direction by
// 8 u L^2 / |n|; a point at most L away is measured wrong by L times that. Twice for the choice between face
// and sides, which the same error decides, and twice for the rest.
double errorOfDistanceToTriangle(const Vector3l& a, const Vector3l& b, const Vector3l& c) {
  constexpr long double kUnit = std::numeric_limits<long double>::epsilon() / 2;
  const long double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
  const long double twice_area = (b - a).cross(c - a).norm();
  return static_cast<double>(4 * 8 * kUnit * longest * longest * longest / twice_area);
}

rc::Gen<double> anyLimit() {
  return rc::gen::map(rc::gen::inRange(8, 300), [](int i) { return i / 100.0; });
}

RC_GTEST_PROP(RefineMesh, LeavesNoEdgeAboveTheLimit, ()) {
  const SurfaceMesh surface = *test::anySurface();
  const double limit = *anyLimit();
  RC_ASSERT(test::longestEdge(refineToEdgeLength(surface, limit).mesh) <= limit * (1.0 + 2.0 * kEpsilon));
}

RC_GTEST_PROP(RefineMesh, MovesNoVertex, ()) {
  const SurfaceMesh surface = *test::anySurface();
  const RefinedMesh refined = refineToEdgeLength(surface, *anyLimit());
  RC_ASSERT(refined.mesh.vertexCount() >= surface.vertexCount());
  for (std::size_t v = 0; v < surface.vertexCount(); ++v) {
    RC_ASSERT(refined.mesh.vertices()[v] == surface.vertices()[v]);
  }
}

RC_GTEST_PROP(RefineMesh, KeepsEveryCornerOnItsOriginalTriangle, ()) {
  const SurfaceMesh surface = *test::anySurface();
  const RefinedMesh refined = refineToEdgeLength(surface, *anyLimit());
  RC_ASSERT(refined.original_triangle.size() == refined.mesh.triangleCount());
  // Each coordinate of a midpoint is rounded once, by half an epsilon of 1; at most 20 deep.
  const double corner_error = 20.0 * std::sqrt(3.0) * 0.5 * kEpsilon;
  for (std::size_t t = 0; t < refined.mesh.triangleCount(); ++t) {
    const TriangleIndex original = refined.original_triangle[t];
    const auto corner = [&](int k) -> Vector3l { return surface.corner(original, k).cast<long double>(); };
    const Vector3l a = corner(0);
    const Vector3l b = corner(1);
    const Vector3l c = corner(2);
    const double bound = corner_error + errorOfDistanceToTriangle(a, b, c);
    for (int k = 0; k < 3; ++k) {
      const Vector3l point = refined.mesh.corner(TriangleIndex{t}, k).cast<long double>();
      RC_ASSERT(static_cast<double>(test::distanceToTriangle(point, a, b, c)) <= bound);
    }
  }
}

RC_GTEST_PROP(RefineMesh, TilesEachOriginalTriangleInItsWinding, ()) {
  const SurfaceMesh surface = *test::anySurface();
  const RefinedMesh refined = refineToEdgeLength(surface, *anyLimit());
  std::vector<double> area(surface.triangleCount(), 0.0);
  std::vector<std::size_t> pieces(surface.triangleCount(), 0);
  for (std::size_t t = 0; t < refined.mesh.triangleCount(); ++t) {
    const std::size_t original = refined.original_triangle[t].value;
    // Signed along the original's normal: a turned or overlapping piece would break the sum.
    area[original] += test::areaVector(refined.mesh, t).dot(test::areaVector(surface, original).normalized());
    ++pieces[original];
  }
  for (std::size_t t = 0; t < surface.triangleCount(); ++t) {
    // Corners off by 40 epsilon change a piece's area by that times its perimeter (at most 12 here).
    const double tolerance = static_cast<double>(pieces[t]) * 12.0 * 40.0 * kEpsilon;
    RC_ASSERT(std::abs(area[t] - test::areaVector(surface, t).norm()) <= tolerance);
  }
}

RC_GTEST_PROP(RefineMesh, ConformsAndKeepsTheTopology, ()) {
  const SurfaceMesh surface = *test::anySurface();
  const SurfaceMesh refined = refineToEdgeLength(surface, *anyLimit()).mesh;
  RC_ASSERT(test::eulerCharacteristic(refined) == test::eulerCharacteristic(surface));
  // A hanging node would leave an edge with fewer triangles on one side than its original edge has.
  const auto before = test::unpairedLength(surface);
  const auto after = test::unpairedLength(refined);
  RC_ASSERT(before.size() == after.size());
  for (const auto& [use, length] : before) {
    RC_ASSERT(after.count(use) == 1U);
    RC_ASSERT(std::abs(after.at(use) - length) <= 1e-10);
  }
}

RC_GTEST_PROP(RefineMesh, HalvesNoAngleMoreThanOnce, ()) {
  // Rosenberg and Stenger 1975: longest-edge bisection keeps every angle at least half the smallest one.
  const SurfaceMesh surface = *test::anySurface();
  const double before = test::smallestAngle(surface);
  RC_PRE(before > 1e-3);
  RC_ASSERT(test::smallestAngle(refineToEdgeLength(surface, *anyLimit()).mesh) >=
            0.5 * before * (1.0 - 1e-9));
}

TEST(RefineMesh, LeavesAMeshAloneThatIsFineEnough) {
  const SurfaceMesh box = makeBox({1.0, 1.0, 1.0});
  const RefinedMesh refined = refineToEdgeLength(box, std::sqrt(2.0) * (1.0 + kEpsilon));
  EXPECT_EQ(refined.mesh.vertices().size(), 8U);
  EXPECT_EQ(refined.mesh.triangles(), box.triangles());
}

TEST(RefineMesh, SharesTheNewNodesOfAnEdgeOfThreeTriangles) {
  const SurfaceMesh book = surfaceOf({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}},
                                     {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}});
  const SurfaceMesh refined = refineToEdgeLength(book, 0.3).mesh;
  std::set<double> heights;
  for (const Eigen::Vector3d& v : refined.vertices()) {
    if (v.x() == 0.0 && v.y() == 0.0) {
      EXPECT_TRUE(heights.insert(v.z()).second) << "two nodes at height " << v.z();
    }
  }
  EXPECT_EQ(heights.size(), 5U);  // a spine of 1 m in four
  std::size_t spine_edges = 0;
  for (const auto& [nodes, use] : test::edgeUses(refined))
    spine_edges += use.first + use.second == 3 ? 1U : 0U;
  EXPECT_EQ(spine_edges, 4U);
}

TEST(RefineMesh, GivesTheSameMeshEveryTime) {
  const SurfaceMesh ball = makeSphere(1.0, 0.05);
  const RefinedMesh one = refineToEdgeLength(ball, 0.1);
  const RefinedMesh two = refineToEdgeLength(ball, 0.1);
  EXPECT_EQ(one.mesh.vertices(), two.mesh.vertices());
  EXPECT_EQ(one.mesh.triangles(), two.mesh.triangles());
}

TEST(RefineMesh, RefusesALengthThatIsNotPositiveAndFinite) {
  const SurfaceMesh box = makeBox({1.0, 1.0, 1.0});
  for (const double bad :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(refineToEdgeLength(box, bad), Error);
  }
}

TEST(RefineMesh, RefusesMoreNodesThanTheLimit) {
  const SurfaceMesh box = makeBox({1.0, 1.0, 1.0});
  EXPECT_THROW(refineToEdgeLength(box, 0.1, 500), Error);  // found while refining
  EXPECT_THROW(refineToEdgeLength(box, 1e-12), Error);     // found at once, from the area
  EXPECT_NO_THROW(refineToEdgeLength(box, 0.1, 5000));
}

TEST(RefineMesh, RefusesATriangleWithARepeatedCorner) {
  const SurfaceMesh folded = surfaceOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 1, 1}});
  EXPECT_THROW(refineToEdgeLength(folded, 0.1), Error);
}

}  // namespace
}  // namespace concave_distance::refine_mesh_test
