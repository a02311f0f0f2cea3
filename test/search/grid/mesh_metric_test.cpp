#include "search/grid/mesh_metric.h"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <algorithm>
#include <cmath>
#include <set>

#include "base/random_engine.h"
#include "support/concave_shapes.h"
#include "support/count_allocations.h"
#include "support/shortest_path.h"

namespace concave_distance::mesh_metric_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kWithMatrices = 4096;
constexpr std::size_t kOnDemand = 0;

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
    const MeshMetric metric(graph, kWithMatrices);
    const auto expected = allPathLengths(graph);
    for (std::uint32_t i = 0; i < graph.nodeCount(); ++i) {
      for (std::uint32_t j = 0; j < graph.nodeCount(); ++j) {
        EXPECT_EQ(metric.matrixDistance(NodeIndex{i}, NodeIndex{j}), static_cast<float>(expected[i][j]));
        EXPECT_EQ(metric.matrixDistance(NodeIndex{i}, NodeIndex{j}),
                  metric.matrixDistance(NodeIndex{j}, NodeIndex{i}));
      }
    }
  }
}

TEST(MeshMetric, OnAFlatSheetItIsTheStaircaseDistance) {
  const double cell = 0.125;  // a float, as are its multiples: only the diagonal is rounded
  const std::uint32_t n = 8;
  const NodeGraph graph = buildNodeGraph(test::makeSheet(n, n, cell));
  const MeshMetric metric(graph, kWithMatrices);
  for (std::uint32_t j = 0; j <= n; ++j) {
    for (std::uint32_t i = 0; i <= n; ++i) {
      const double expected = cell * (std::min(i, j) * std::sqrt(2.0) + (std::max(i, j) - std::min(i, j)));
      EXPECT_NEAR(metric.matrixDistance(NodeIndex{0}, NodeIndex{j * (n + 1) + i}), expected,
                  expected * 0x1.0p-22);
    }
  }
}

TEST(MeshMetric, KeepsMatricesUpToTheLimitAndNotBeyond) {
  const NodeGraph graph = buildNodeGraph(test::makeSheet(9, 9));
  EXPECT_TRUE(MeshMetric(graph, 100).hasMatrices());
  EXPECT_FALSE(MeshMetric(graph, 99).hasMatrices());
}

TEST(MeshMetric, NeverKeepsMatricesThatPredecessorsOf16BitsCannotIndex) {
  const NodeGraph graph = buildNodeGraph(test::makeSheet(255, 255));
  ASSERT_EQ(graph.nodeCount(), 65536U);
  EXPECT_FALSE(MeshMetric(graph, 1'000'000).hasMatrices());
}

RC_GTEST_PROP(MeshMetric, ObeysTheTriangleInequalityWithinTheStatedBound, ()) {
  static const NodeGraph kGraph = buildNodeGraph(wavySheet());
  static const MeshMetric kMetric(kGraph, kWithMatrices);
  const NodeIndex a = drawNode(kGraph);
  const NodeIndex b = drawNode(kGraph);
  const NodeIndex c = drawNode(kGraph);
  const auto delta = [&](NodeIndex l, NodeIndex r) {
    return static_cast<double>(kMetric.matrixDistance(l, r));
  };
  RC_ASSERT(delta(a, c) <= (delta(a, b) + delta(b, c)) * (1.0 + 0x1.0p-22));
  RC_ASSERT(delta(a, c) >=
            (kGraph.positions[a.value] - kGraph.positions[c.value]).norm() * (1.0 - 0x1.0p-23));
}

RC_GTEST_PROP(MeshMetric, OnDemandQueriesEqualTheMatrices, ()) {
  static const NodeGraph kGraph = buildNodeGraph(twoShells());
  static const MeshMetric kMatrices(kGraph, kWithMatrices);
  static const MeshMetric kBounded(kGraph, kOnDemand);
  static MeshMetricQuery query(kBounded);  // one cache over all cases: balls are reused and overwritten
  const NodeIndex from = drawNode(kGraph);
  const NodeIndex to = drawNode(kGraph);
  const auto exact = static_cast<double>(kMatrices.matrixDistance(from, to));
  const double bound =
      *rc::gen::element(0.0, 0.1, 0.3, 0.7, 5.0, kInfinity, exact, std::nextafter(exact, 0.0));
  RC_ASSERT(query.distanceWithin(from, to, bound) == (exact <= bound ? exact : kInfinity));
  RC_ASSERT(MeshMetricQuery(kMatrices).distanceWithin(from, to, bound) ==
            (exact <= bound ? exact : kInfinity));
}

RC_GTEST_PROP(MeshMetric, PathsRunAlongEdgesAndAreAsLongAsTheDistance, ()) {
  static const NodeGraph kGraph = buildNodeGraph(twoShells());
  static const MeshMetric kMatrices(kGraph, kWithMatrices);
  const NodeIndex from = drawNode(kGraph);
  const NodeIndex to = drawNode(kGraph);
  const float distance = kMatrices.matrixDistance(from, to);
  const std::vector<NodeIndex> path = test::shortestPath(kGraph, from, to);
  if (!std::isfinite(distance)) {
    RC_ASSERT(path.empty());
    return;
  }
  RC_ASSERT(path.front() == from);
  RC_ASSERT(path.back() == to);
  RC_ASSERT(static_cast<float>(pathLength(kGraph, path)) == distance);
}

TEST(MeshMetric, IsInfiniteBetweenShells) {
  const NodeGraph graph = buildNodeGraph(twoShells());
  const NodeIndex first{0};
  const NodeIndex last{graph.nodeCount() - 1};
  for (const std::size_t matrix_node_limit : {kWithMatrices, kOnDemand}) {
    const MeshMetric metric(graph, matrix_node_limit);
    EXPECT_EQ(MeshMetricQuery(metric).distanceWithin(first, last, kInfinity), kInfinity);
  }
}

TEST(MeshMetric, TheCacheSurvivesBeingOverwrittenManyTimes) {
  const NodeGraph graph = buildNodeGraph(test::makeSheet(30, 30, 0.1, 0.1));
  const MeshMetric matrices(graph, kWithMatrices);
  const MeshMetric bounded(graph, kOnDemand);
  MeshMetricQuery query(bounded);
  RandomEngine engine(20);
  for (int i = 0; i < 20000; ++i) {
    const NodeIndex from{uniformIndex(engine, static_cast<std::uint32_t>(graph.nodeCount()))};
    const NodeIndex to{uniformIndex(engine, static_cast<std::uint32_t>(graph.nodeCount()))};
    const double bound = 0.2 + 3.0 * std::pow(uniformUnit(engine), 4.0);
    const auto exact = static_cast<double>(matrices.matrixDistance(from, to));
    ASSERT_EQ(query.distanceWithin(from, to, bound), exact <= bound ? exact : kInfinity) << "query " << i;
  }
}

TEST(MeshMetric, MemoryOfQueriesBeyondTheMatricesIsLinearInNodes) {
  for (const std::uint32_t n : {30U, 120U, 240U}) {
    const NodeGraph graph = buildNodeGraph(test::makeSheet(n, n));
    const MeshMetric metric(graph, kOnDemand);
    const std::size_t before = allocated_bytes;
    MeshMetricQuery query(metric);
    for (std::uint32_t i = 0; i < 25; ++i) {  // more full balls than there is room for
      query.distanceWithin(NodeIndex{i * 13}, NodeIndex{graph.nodeCount() - 1}, kInfinity);
    }
    EXPECT_LE(allocated_bytes - before, std::max<std::size_t>(260 * graph.nodeCount(), 4'000'000));
  }
}

TEST(MeshMetric, NodeTowardsIsTheLastNodeWithinTheDistanceOnAShortestPath) {
  const NodeGraph graph = buildNodeGraph(wavySheet());
  const MeshMetric matrices(graph, kWithMatrices);
  const MeshMetric bounded(graph, kOnDemand);
  MeshMetricQuery with_matrices(matrices);
  MeshMetricQuery on_demand(bounded);
  RandomEngine engine(3);
  for (int i = 0; i < 3000; ++i) {
    const NodeIndex from{uniformIndex(engine, static_cast<std::uint32_t>(graph.nodeCount()))};
    const NodeIndex to{uniformIndex(engine, static_cast<std::uint32_t>(graph.nodeCount()))};
    const auto length = static_cast<double>(matrices.matrixDistance(from, to));
    const double distance = 1.2 * length * uniformUnit(engine);
    for (MeshMetricQuery* query : {&with_matrices, &on_demand}) {
      const NodeIndex node = query->nodeTowards(from, to, distance, kInfinity);
      const auto before = static_cast<double>(matrices.matrixDistance(from, node));
      const auto after = static_cast<double>(matrices.matrixDistance(node, to));
      EXPECT_NEAR(before + after, length, length * 0x1.0p-22);
      EXPECT_LE(before, distance + length * 0x1.0p-22);
      if (node != to) {
        // One edge farther would be beyond the distance; no edge here is longer than 0.2.
        EXPECT_GE(before, distance - 0.2);
      }
    }
    EXPECT_EQ(on_demand.nodeTowards(from, to, 0.5 * length, 0.5 * length), from)
        << "no path within the bound";
  }
}

TEST(MeshMetric, NodeInBallStaysWithinTheRadiusAndReachesEveryNodeOfIt) {
  const NodeGraph graph = buildNodeGraph(twoShells());
  const MeshMetric matrices(graph, kWithMatrices);
  const MeshMetric bounded(graph, kOnDemand);
  MeshMetricQuery query(bounded);
  const NodeIndex centre{12};
  std::set<std::uint32_t> expected;
  for (std::uint32_t i = 0; i < graph.nodeCount(); ++i) {
    if (matrices.matrixDistance(centre, NodeIndex{i}) <= 0.25F) {
      expected.insert(i);
    }
  }
  std::set<std::uint32_t> found;
  for (int i = 0; i < 1000; ++i) {
    found.insert(query.nodeInBall(centre, 0.25, i / 1000.0).value);
  }
  EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace concave_distance::mesh_metric_test
