#include "mesh/surface/facets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

#include "concave_distance/mesh/surface/primitives.h"
#include "support/body_pairs.h"
#include "support/exact_triangle_distance.h"
#include "support/plain_shapes.h"

namespace concave_distance::facets_test {
namespace {

using Eigen::Vector3d;

Facets facetsOf(const SurfaceMesh& mesh, const std::vector<bool>& hidden = {}) {
  return joinFlatTriangles(mesh, buildMeshTopology(mesh), hidden);
}

std::size_t quadCount(const Facets& facets) {
  return static_cast<std::size_t>(std::count_if(facets.second.begin(), facets.second.end(),
                                                [](TriangleIndex t) { return t != kNoTriangle; }));
}

/// Exactly how far the fourth corner is from the plane of the others, metres.
double exactHeight(const std::array<Vector3d, 4>& corners) {
  using test::Wide;
  using Point = test::ExactVector<Wide>;
  const Point origin(corners[0]);
  const Point normal = (Point(corners[1]) - origin).cross(Point(corners[2]) - origin);
  return static_cast<double>(abs(normal.dot(Point(corners[3]) - origin)) / sqrt(normal.squaredNorm()));
}

TEST(Facets, OfABoxAreItsSides) {
  const SurfaceMesh box = makeBox(Vector3d(1.0, 2.0, 3.0));
  const Facets facets = facetsOf(box);
  EXPECT_EQ(quadCount(facets), 6U);
  const auto adjacency = facetAdjacency(facets, triangleAdjacency(box, buildMeshTopology(box)));
  for (std::uint32_t t = 0; t < box.triangleCount(); ++t) {
    const TriangleIndex facet = facets.facet_of_triangle[t];
    EXPECT_TRUE(facet == TriangleIndex{t} || facets.second[facet.value] == TriangleIndex{t});
    EXPECT_EQ(adjacency.row(t).size(), facet == TriangleIndex{t} ? 4U : 0U);
  }
}

TEST(Facets, AreFlatAndConvexAndHoldEveryTriangleOnce) {
  std::size_t quads = 0;
  for (std::uint32_t k = 0; k < 24; ++k) {
    const SurfaceMesh mesh = test::concaveShape(k);
    const Facets facets = facetsOf(mesh);
    quads += quadCount(facets);
    std::vector<int> found(mesh.triangleCount(), 0);
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
      if (facets.facet_of_triangle[t] != TriangleIndex{t}) continue;
      ++found[t];
      const std::array<NodeIndex, 4>& nodes = facets.nodes[t];
      for (std::size_t i = 0; i < 3; ++i) {
        const TriangleNodes& own = mesh.triangle(TriangleIndex{t});
        EXPECT_NE(std::find(own.begin(), own.end(), nodes[i]), own.end());
      }
      if (!facets.isQuad(TriangleIndex{t})) continue;
      ++found[facets.second[t].value];
      std::array<Vector3d, 4> corners;
      for (std::size_t i = 0; i < 4; ++i) corners[i] = mesh.vertex(nodes[i]);
      EXPECT_LE(exactHeight(corners), std::exp2(-47.4) * mesh.diameter());
      const Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
      for (std::size_t i = 0; i < 4; ++i) {
        const Vector3d in = corners[(i + 1) % 4] - corners[i];
        EXPECT_GT(in.cross(corners[(i + 2) % 4] - corners[(i + 1) % 4]).dot(normal), 0.0);
      }
    }
    EXPECT_TRUE(std::all_of(found.begin(), found.end(), [](int count) { return count == 1; }));
  }
  EXPECT_GT(quads, 50U);
}

TEST(Facets, LeaveHiddenTrianglesAlone) {
  const SurfaceMesh box = makeBox(Vector3d(1.0, 2.0, 3.0));
  std::vector<bool> hidden(box.triangleCount(), false);
  hidden[0] = true;
  EXPECT_EQ(quadCount(facetsOf(box, hidden)), 5U);
}

TEST(Facets, AreNotBent) {
  const double lift = 1e-12;
  for (const double height : {0.0, lift}) {
    const SurfaceMesh sheet(
        {{0, 0, 0}, {1, 0, 0}, {1, 1, height}, {0, 1, 0}},
        {{NodeIndex{0}, NodeIndex{1}, NodeIndex{2}}, {NodeIndex{0}, NodeIndex{2}, NodeIndex{3}}}, "sheet");
    EXPECT_EQ(quadCount(facetsOf(sheet)), height == 0.0 ? 1U : 0U);
  }
}

TEST(Facets, AreNotReflex) {
  const SurfaceMesh arrow(
      {{0, 0, 0}, {1, 0.2, 0}, {0.3, 0.3, 0}, {0.2, 1, 0}},
      {{NodeIndex{0}, NodeIndex{1}, NodeIndex{2}}, {NodeIndex{0}, NodeIndex{2}, NodeIndex{3}}}, "arrow");
  EXPECT_EQ(quadCount(facetsOf(arrow)), 0U);
}

}  // namespace
}  // namespace concave_distance::facets_test
