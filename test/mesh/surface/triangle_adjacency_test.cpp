#include "mesh/surface/triangle_adjacency.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "support/body_pairs.h"
#include "support/plain_shapes.h"

namespace concave_distance::triangle_adjacency_test {
namespace {

using Eigen::Vector3d;

CompressedRows<AdjacentTriangle> adjacencyOf(const SurfaceMesh& mesh) {
  return triangleAdjacency(mesh, buildMeshTopology(mesh));
}

using Step = std::tuple<std::uint32_t, NodeIndex, NodeIndex>;

std::vector<Step> stepsFrom(const CompressedRows<AdjacentTriangle>& adjacency, std::size_t t) {
  std::vector<Step> steps;
  for (const AdjacentTriangle& next : adjacency.row(t))
    steps.emplace_back(next.triangle.value, next.from, next.to);
  std::sort(steps.begin(), steps.end());
  return steps;
}

/// By comparing every two triangles.
std::vector<Step> stepsAcrossEdges(const SurfaceMesh& mesh, std::size_t t) {
  std::vector<Step> steps;
  const TriangleNodes& nodes = mesh.triangles()[t];
  for (std::uint32_t other = 0; other < mesh.triangleCount(); ++other) {
    const TriangleNodes& with = mesh.triangles()[other];
    const auto has = [&](NodeIndex node) { return std::find(with.begin(), with.end(), node) != with.end(); };
    for (std::size_t k = 0; k < 3; ++k) {
      const NodeIndex from = nodes[k];
      const NodeIndex to = nodes[(k + 1) % 3];
      if (other != t && has(from) && has(to)) steps.emplace_back(other, from, to);
    }
  }
  std::sort(steps.begin(), steps.end());
  return steps;
}

/// Pages that share the edge from (0, 0, 0) to (0, 0, 1).
SurfaceMesh makeBook(std::uint32_t pages) {
  std::vector<Vector3d> vertices{Vector3d::Zero(), Vector3d::UnitZ()};
  std::vector<TriangleNodes> triangles;
  for (std::uint32_t i = 0; i < pages; ++i) {
    const double angle = 2.0 * M_PI * i / pages;
    vertices.emplace_back(std::cos(angle), std::sin(angle), 0.5);
    triangles.push_back({NodeIndex{i % 2}, NodeIndex{1 - i % 2}, NodeIndex{2 + i}});
  }
  return SurfaceMesh(std::move(vertices), std::move(triangles), "book");
}

TEST(TriangleAdjacency, NamesEveryTriangleAcrossAnEdge) {
  for (const SurfaceMesh& mesh : {test::makeComb(3), test::makeFan(50), makeBook(3), makeBook(8)}) {
    const auto adjacency = adjacencyOf(mesh);
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
      EXPECT_EQ(stepsFrom(adjacency, t), stepsAcrossEdges(mesh, t)) << "triangle " << t;
    }
  }
}

TEST(TriangleAdjacency, ChainsOverAVertexWhatNoEdgeConnectsThere) {
  // Three corners that meet in vertex 0; the first two triangles share an edge there.
  const SurfaceMesh mesh =
      test::makeSurface({Vector3d::Zero(), Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(-1, 0, 0),
                         Vector3d(0, -1, 0), Vector3d(1, 0, 1), Vector3d(0, 1, 1), Vector3d(-1, 0, 1)},
                        {{0, 1, 2}, {0, 2, 3}, {4, 5, 0}, {6, 0, 7}});
  const auto adjacency = adjacencyOf(mesh);
  const NodeIndex hub{0};
  EXPECT_EQ(stepsFrom(adjacency, 0), (std::vector<Step>{{1, NodeIndex{2}, hub}, {2, hub, hub}}));
  EXPECT_EQ(stepsFrom(adjacency, 1), (std::vector<Step>{{0, hub, NodeIndex{2}}}));
  EXPECT_EQ(stepsFrom(adjacency, 2), (std::vector<Step>{{0, hub, hub}, {3, hub, hub}}));
  EXPECT_EQ(stepsFrom(adjacency, 3), (std::vector<Step>{{2, hub, hub}}));
}

TEST(TriangleAdjacency, ManyTrianglesAtAnEdgeMakeOneRing) {
  constexpr std::uint32_t kPages = 200'000;
  const auto adjacency = adjacencyOf(makeBook(kPages));
  ASSERT_EQ(adjacency.values.size(), kPages);
  std::uint32_t page = 0;
  for (std::uint32_t i = 0; i < kPages; ++i) {
    EXPECT_EQ(adjacency.row(page)[0].from.value + adjacency.row(page)[0].to.value, 1U);
    page = adjacency.row(page)[0].triangle.value;
    ASSERT_EQ(page == 0, i + 1 == kPages) << "after " << i << " steps";
  }
}

TEST(TriangleAdjacency, ManyTrianglesAroundAVertexCostNoMoreThanElsewhere) {
  constexpr std::uint32_t kTriangles = 1'000'000;
  const auto adjacency = adjacencyOf(test::makeFan(kTriangles));
  EXPECT_EQ(adjacency.values.size(), 2 * kTriangles);
}

}  // namespace
}  // namespace concave_distance::triangle_adjacency_test
