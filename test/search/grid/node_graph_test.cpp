#include "search/grid/node_graph.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "concave_distance/mesh/surface/primitives.h"
#include "mesh/surface/refine_mesh.h"
#include "search/grid/thin_graph.h"
#include "support/concave_shapes.h"

namespace concave_distance::node_graph_test {
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

TEST(NodeGraph, NeighbourhoodsHoldEveryNeighbourInAscendingOrder) {
  const NodeGraph graph = buildNodeGraph(test::makeComb(5));  // its fans have more than eight neighbours
  std::size_t largest = 0;
  for (std::uint32_t i = 0; i < graph.nodeCount(); ++i) {
    const auto row = graph.edges.row(i);
    largest = std::max(largest, row.size());
    std::uint32_t part = i;
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (k > 0 && k % NodeGraph::Neighbourhood::kSize == 0) {
        part = graph.neighbourhoods[part].more;
        ASSERT_LT(part, graph.neighbourhoods.size());
      }
      EXPECT_TRUE(k == 0 || row[k - 1].to < row[k].to);
      const NodeGraph::Neighbourhood& seats = graph.neighbourhoods[part];
      const std::size_t seat = k % NodeGraph::Neighbourhood::kSize;
      EXPECT_EQ(seats.to[seat], row[k].to.value);
      const Eigen::Vector3d position =
          graph.neighbourhood_origin + Eigen::Vector3d(static_cast<double>(seats.x[seat]),
                                                       static_cast<double>(seats.y[seat]),
                                                       static_cast<double>(seats.z[seat]));
      EXPECT_LE((position - graph.positions[row[k].to.value]).norm(), 1e-7);  // 1 m across, 24 bits
    }
    EXPECT_EQ(graph.neighbourhoods[part].more, NodeGraph::Neighbourhood::kNoMore);
  }
  EXPECT_GT(largest, NodeGraph::Neighbourhood::kSize);
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
  const SurfaceMesh two = test::makeJoined(test::makeLShape(), test::makeHook(), {3.0, 0.0, 0.0});
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

TEST(ThinGraph, KeepsTheNumberAskedForAndTheirPlaces) {
  const NodeGraph graph = buildNodeGraph(refineToEdgeLength(makeBox({1.0, 1.0, 1.0}), 0.05).mesh);
  const ThinnedGraph thinned = thinGraph(graph, 200);
  ASSERT_EQ(thinned.graph.nodeCount(), 200U);
  std::set<std::uint32_t> seen;
  for (std::size_t i = 0; i < 200; ++i) {
    EXPECT_TRUE(seen.insert(thinned.original_node[i].value).second);
    EXPECT_EQ(thinned.graph.positions[i], graph.positions[thinned.original_node[i].value]);
    EXPECT_FALSE(thinned.graph.edges.row(i).empty());
  }
}

TEST(ThinGraph, SpreadsEvenly) {
  // Farthest-point sampling: chosen nodes are apart at least half as far as any node is from them at worst
  // times two; checked through the separation alone: area 6, 200 nodes, hexagonal packing 0.186 apart.
  const NodeGraph graph = buildNodeGraph(refineToEdgeLength(makeBox({1.0, 1.0, 1.0}), 0.02).mesh);
  const ThinnedGraph thinned = thinGraph(graph, 200);
  double least = 1.0;
  for (std::size_t i = 0; i < 200; ++i) {
    for (std::size_t j = i + 1; j < 200; ++j) {
      least = std::min(least, (thinned.graph.positions[i] - thinned.graph.positions[j]).norm());
    }
  }
  EXPECT_GT(least, 0.5 * 0.186);
}

TEST(ThinGraph, KeepsShellsApartAndEachAlive) {
  const SurfaceMesh two =
      test::makeJoined(makeBox({1.0, 1.0, 1.0}), makeBox({0.1, 0.1, 0.1}), {3.0, 0.0, 0.0});
  const ThinnedGraph thinned = thinGraph(buildNodeGraph(refineToEdgeLength(two, 0.1).mesh), 50);
  EXPECT_EQ(thinned.graph.shell_count, 2U);
}

TEST(ThinGraph, LeavesASmallGraphWhole) {
  const NodeGraph graph = buildNodeGraph(makeBox({1.0, 1.0, 1.0}));
  const ThinnedGraph thinned = thinGraph(graph, 100);
  EXPECT_EQ(thinned.graph.nodeCount(), graph.nodeCount());
  EXPECT_EQ(thinned.graph.edges.values.size(), graph.edges.values.size());
}

}  // namespace
}  // namespace concave_distance::node_graph_test
