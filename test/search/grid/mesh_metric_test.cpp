#include "search/grid/mesh_metric.h"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <algorithm>
#include <cmath>

#include "base/random_engine.h"
#include "search/grid/thin_graph.h"
#include "support/concave_shapes.h"
#include "support/count_allocations.h"
#include "support/shortest_path.h"

namespace concave_distance::mesh_metric_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kAllNodes = 4096;

SurfaceMesh wavySheet() {
  return test::makeSheet(11, 9, 0.1, 0.2);
}
SurfaceMesh twoShells() {
  return test::makeJoined(test::makeSheet(4, 4, 0.1, 0.1), test::makeSheet(3, 2, 0.2, 0.3), {0.0, 0.0, 1.0});
}

/// All shortest path lengths, exactly: Floyd and Warshall over the same edge lengths.
std::vector<std::vector<double>> allPathLengths(const NodeGraph& graph) {
  const std::size_t n = graph.nodeCount();
  std::vector<std::vector<double>> length(n, std::vector<double>(n, kInfinity));
  for (std::size_t i = 0; i < n; ++i) {
    length[i][i] = 0.0;
    for (const NodeGraph::Edge& edge : graph.edges.row(i)) {
      length[i][edge.to.value] = static_cast<double>(edge.length);
    }
  }
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        length[i][j] = std::min(length[i][j], length[i][k] + length[k][j]);
      }
    }
  }
  return length;
}

double pathLength(const NodeGraph& graph, const std::vector<NodeIndex>& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    double step = kInfinity;
    for (const NodeGraph::Edge& edge : graph.edges.row(path[i - 1].value)) {
      if (edge.to == path[i]) {
        step = static_cast<double>(edge.length);
      }
    }
    length += step;  // infinite when the path leaves the edges
  }
  return length;
}

NodeIndex drawNode(const NodeGraph& graph) {
  return NodeIndex{*rc::gen::inRange(0U, static_cast<std::uint32_t>(graph.nodeCount()))};
}

TEST(MeshMetric, MatricesEqualTheExactPathLengthsRoundedOnce) {
  for (const SurfaceMesh& mesh : {wavySheet(), twoShells(), test::makeComb(4)}) {
    const NodeGraph graph = buildNodeGraph(mesh);
    const MeshMetric metric(graph, kAllNodes);
    const auto expected = allPathLengths(graph);
    for (std::uint32_t i = 0; i < graph.nodeCount(); ++i) {
      for (std::uint32_t j = 0; j < graph.nodeCount(); ++j) {
        EXPECT_EQ(metric.distance(NodeIndex{i}, NodeIndex{j}),
                  static_cast<double>(static_cast<float>(expected[i][j])));
        EXPECT_EQ(metric.distance(NodeIndex{i}, NodeIndex{j}), metric.distance(NodeIndex{j}, NodeIndex{i}));
      }
    }
  }
}

TEST(MeshMetric, OnAFlatSheetItIsTheStaircaseDistance) {
  const double cell = 0.125;  // a float, as are its multiples: only the diagonal is rounded
  const std::uint32_t n = 8;
  const NodeGraph graph = buildNodeGraph(test::makeSheet(n, n, cell));
  const MeshMetric metric(graph, kAllNodes);
  for (std::uint32_t j = 0; j <= n; ++j) {
    for (std::uint32_t i = 0; i <= n; ++i) {
      const double expected = cell * (std::min(i, j) * std::sqrt(2.0) + (std::max(i, j) - std::min(i, j)));
      EXPECT_NEAR(metric.distance(NodeIndex{0}, NodeIndex{j * (n + 1) + i}), expected, expected * 0x1.0p-22);
    }
  }
}

RC_GTEST_PROP(MeshMetric, ObeysTheTriangleInequalityWithinTheStatedBound, ()) {
  static const NodeGraph kGraph = buildNodeGraph(wavySheet());
  static const MeshMetric kMetric(kGraph, kAllNodes);
  const NodeIndex a = drawNode(kGraph);
  const NodeIndex b = drawNode(kGraph);
  const NodeIndex c = drawNode(kGraph);
  const auto delta = [&](NodeIndex l, NodeIndex r) { return kMetric.distance(l, r); };
  RC_ASSERT(delta(a, c) <= (delta(a, b) + delta(b, c)) * (1.0 + 0x1.0p-22));
  RC_ASSERT(delta(a, c) >=
            (kGraph.positions[a.value] - kGraph.positions[c.value]).norm() * (1.0 - 0x1.0p-23));
}

RC_GTEST_PROP(MeshMetric, PathsRunAlongEdgesAndAreAsLongAsTheDistance, ()) {
  static const NodeGraph kGraph = buildNodeGraph(twoShells());
  static const MeshMetric kMatrices(kGraph, kAllNodes);
  const NodeIndex from = drawNode(kGraph);
  const NodeIndex to = drawNode(kGraph);
  const double distance = kMatrices.distance(from, to);
  const std::vector<NodeIndex> path = test::shortestPath(kGraph, from, to);
  if (!std::isfinite(distance)) {
    RC_ASSERT(path.empty());
    return;
  }
  RC_ASSERT(path.front() == from);
  RC_ASSERT(path.back() == to);
  RC_ASSERT(static_cast<float>(pathLength(kGraph, path)) == static_cast<float>(distance));
}

TEST(MeshMetric, IsInfiniteBetweenShells) {
  const NodeGraph graph = buildNodeGraph(twoShells());
  const NodeIndex first{0};
  const NodeIndex last{graph.nodeCount() - 1};
  for (const std::size_t limit : {kAllNodes, std::size_t{10}, std::size_t{1}}) {
    EXPECT_EQ(MeshMetric(graph, limit).distance(first, last), kInfinity) << limit;
  }
}

TEST(MeshMetric, OfMoreNodesThanTheLimitEachStandsWhereThatOfItsRegionDoes) {
  for (const SurfaceMesh& mesh : {wavySheet(), twoShells(), test::makeComb(4)}) {
    const NodeGraph graph = buildNodeGraph(mesh);
    constexpr std::size_t kLimit = 20;
    ASSERT_GT(graph.nodeCount(), kLimit);
    EXPECT_FALSE(MeshMetric(graph, graph.nodeCount()).isThinned());
    const MeshMetric metric(graph, kLimit);
    EXPECT_TRUE(metric.isThinned());
    const ThinnedGraph thinned = thinGraph(graph, kLimit);
    const auto expected = allPathLengths(thinned.graph);
    for (std::uint32_t i = 0; i < graph.nodeCount(); ++i) {
      for (std::uint32_t j = 0; j < graph.nodeCount(); ++j) {
        const double length = expected[thinned.nearest[i].value][thinned.nearest[j].value];
        EXPECT_EQ(metric.distance(NodeIndex{i}, NodeIndex{j}),
                  static_cast<double>(static_cast<float>(length)));
      }
    }
  }
}

TEST(MeshMetric, MatricesTakeNoMoreThanTheLimitAllows) {
  for (const std::uint32_t n : {9U, 60U, 300U}) {
    const NodeGraph graph = buildNodeGraph(test::makeSheet(n, n));
    const std::size_t before = allocated_bytes.load();
    const MeshMetric metric(graph, 100);
    EXPECT_LE(allocated_bytes.load() - before, MeshMetric::matrixBytes(100) + 8 * graph.nodeCount() + 4096);
  }
}

// Loose triangles, as of a cloud: nothing to keep between them, however many they are.
TEST(MeshMetric, ShellsBeyondTheLimitHaveNoMatrices) {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<TriangleNodes> triangles;
  for (std::uint32_t i = 0; i < 70000; ++i) {
    for (std::uint32_t k = 0; k < 3; ++k) vertices.emplace_back(i, k == 1 ? 0.5 : 0.0, k == 2 ? 0.5 : 0.0);
    triangles.push_back({NodeIndex{3 * i}, NodeIndex{3 * i + 1}, NodeIndex{3 * i + 2}});
  }
  const NodeGraph graph = buildNodeGraph(SurfaceMesh(vertices, triangles, "loose"));
  const std::size_t before = allocated_bytes.load();
  const MeshMetric metric(graph, 1'000'000);
  EXPECT_LE(allocated_bytes.load() - before, 8 * graph.nodeCount() + 4096);
  EXPECT_EQ(metric.distance(NodeIndex{3}, NodeIndex{5}), 0.0);
  EXPECT_EQ(metric.distance(NodeIndex{3}, NodeIndex{6}), kInfinity);
  EXPECT_EQ(metric.nodeTowards(NodeIndex{3}, NodeIndex{6}, 1.0), NodeIndex{3});
}

TEST(MeshMetric, NodeTowardsIsTheLastNodeWithinTheDistanceOnAShortestPath) {
  const NodeGraph graph = buildNodeGraph(wavySheet());
  RandomEngine engine(3);
  for (const std::size_t limit : {kAllNodes, std::size_t{60}}) {
    const MeshMetric metric(graph, limit);
    // One edge farther would be beyond the distance.
    const double longest_edge = limit == kAllNodes ? 0.2 : thinGraph(graph, limit).longest_edge;
    for (int i = 0; i < 3000; ++i) {
      const NodeIndex from{uniformIndex(engine, static_cast<std::uint32_t>(graph.nodeCount()))};
      const NodeIndex to{uniformIndex(engine, static_cast<std::uint32_t>(graph.nodeCount()))};
      const double length = metric.distance(from, to);
      const double distance = 1.2 * length * uniformUnit(engine);
      const NodeIndex node = metric.nodeTowards(from, to, distance);
      const double before = metric.distance(from, node);
      const double after = metric.distance(node, to);
      EXPECT_NEAR(before + after, length, length * 0x1.0p-22);
      EXPECT_LE(before, distance + length * 0x1.0p-22);
      if (after > 0.0) {
        EXPECT_GE(before, distance - longest_edge * (1.0 + 0x1.0p-22));
      }
    }
  }
}

}  // namespace
}  // namespace concave_distance::mesh_metric_test
