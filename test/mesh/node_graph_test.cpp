#include "concave_distance/mesh/node_graph.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "support/concave_shapes.h"

namespace concave_distance {
namespace {

TEST(NodeGraph, HasEveryMeshEdgeOnceInBothDirections) {
  const SurfaceMesh mesh = test::makeComb(3);
  std::set<std::pair<std::uint32_t, std::uint32_t>> expected;
  for (const TriangleNodes& t : mesh.triangles()) {
    for (std::size_t k = 0; k < 3; ++k) {
      expected.emplace(t[k].value, t[(k + 1) % 3].value);
      expected.emplace(t[(k + 1) % 3].value, t[k].value);
    }
  }
  const NodeGraph graph = buildNodeGraph(mesh);
  std::set<std::pair<std::uint32_t, std::uint32_t>> found;
  for (std::uint32_t i = 0; i < graph.nodeCount(); ++i) {
    for (const NodeGraph::Edge& edge : graph.edges.row(i)) {
      EXPECT_TRUE(found.emplace(i, edge.to.value).second);
    }
  }
  EXPECT_EQ(found, expected);
}

TEST(NodeGraph, NeighboursAscendAndTheirPositionsStandBesideThem) {
  const NodeGraph graph = buildNodeGraph(test::makeSheet(7, 5, 0.1, 0.05));
  ASSERT_EQ(graph.neighbour_positions.size(), graph.edges.values.size());
  for (std::size_t i = 0; i < graph.nodeCount(); ++i) {
    for (std::size_t k = graph.edges.offsets[i]; k < graph.edges.offsets[i + 1]; ++k) {
      const NodeGraph::Edge& edge = graph.edges.values[k];
      EXPECT_TRUE(k == graph.edges.offsets[i] || graph.edges.values[k - 1].to < edge.to);
      EXPECT_EQ(graph.neighbour_positions[k], graph.positions[edge.to.value]);
    }
  }
}

TEST(NodeGraph, LengthsAreWholeQuantaJustAboveTheStraightDistance) {
  const NodeGraph graph = buildNodeGraph(test::makeSheet(9, 8, 0.1, 0.07));
  double total = 0.0;
  for (std::size_t i = 0; i < graph.nodeCount(); ++i) {
    for (const NodeGraph::Edge& edge : graph.edges.row(i)) {
      const double straight = (graph.positions[edge.to.value] - graph.positions[i]).norm();
      const double length = edge.length;
      total += 0.5 * straight;
      EXPECT_GE(length, straight * (1.0 - 0x1.0p-50));
      EXPECT_LE(length, straight * (1.0 + 0x1.0p-23) + graph.length_quantum);
      EXPECT_EQ(std::fmod(length, graph.length_quantum), 0.0);
    }
  }
  EXPECT_LE(graph.length_quantum, total * 0x1.0p-50);
}

TEST(NodeGraph, LengthsKeepTheirQuantumOverElevenDecades) {
  // One edge of 1e-6 m beside edges of 1e5 m: a plain float would be finer than the sums can hold.
  const SurfaceMesh mesh(
      {{0, 0, 0}, {1e-6, 0, 0}, {0, 1e5, 0}, {1e5, 1e5, 0}},
      {{NodeIndex{0}, NodeIndex{1}, NodeIndex{2}}, {NodeIndex{1}, NodeIndex{3}, NodeIndex{2}}}, "sliver");
  const NodeGraph graph = buildNodeGraph(mesh);
  for (const NodeGraph::Edge& edge : graph.edges.values) {
    EXPECT_EQ(std::fmod(static_cast<double>(edge.length), graph.length_quantum), 0.0);
    EXPECT_GE(static_cast<double>(edge.length), 1e-6);
  }
}

TEST(NodeGraph, ShellsAreNumberedByTheirFirstNode) {
  const SurfaceMesh two = test::makeUnion(test::makeLShape(), test::makeHook(), {3.0, 0.0, 0.0});
  const NodeGraph graph = buildNodeGraph(two);
  EXPECT_EQ(graph.shell_count, 2U);
  EXPECT_EQ(graph.shell.front(), 0U);
  EXPECT_EQ(graph.shell.back(), 1U);
}

TEST(NodeGraph, AnUnusedVertexIsAShellOfItsOwn) {
  const SurfaceMesh mesh({{0, 0, 0}, {5, 5, 5}, {1, 0, 0}, {0, 1, 0}},
                         {{NodeIndex{0}, NodeIndex{2}, NodeIndex{3}}}, "spare vertex");
  const NodeGraph graph = buildNodeGraph(mesh);
  EXPECT_EQ(graph.shell_count, 2U);
  EXPECT_EQ(graph.shell[1], 1U);
  EXPECT_TRUE(graph.edges.row(1).empty());
}

TEST(NodeGraph, ATriangleThatNamesANodeTwiceGivesNoLoop) {
  const SurfaceMesh mesh({{0, 0, 0}, {1, 0, 0}}, {{NodeIndex{0}, NodeIndex{1}, NodeIndex{1}}}, "degenerate");
  const NodeGraph graph = buildNodeGraph(mesh);
  ASSERT_EQ(graph.edges.row(0).size(), 1U);
  ASSERT_EQ(graph.edges.row(1).size(), 1U);
  EXPECT_EQ(graph.edges.row(1)[0].to, NodeIndex{0});
}

}  // namespace
}  // namespace concave_distance
