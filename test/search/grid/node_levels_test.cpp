#include "search/grid/node_levels.h"
#include "search/grid/mesh_metric.h"

#include <gtest/gtest.h>

#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "search/grid/body_grid.h"
#include "search/grid/search_grid.h"
#include "support/concave_shapes.h"
#include "support/count_allocations.h"

namespace concave_distance::node_levels_test {
namespace {

NodeGraph graphOf(const SurfaceMesh& surface, double edge) {
  return buildNodeGraph(makeSearchGrid(surface, edge).mesh);
}

TEST(NodeLevels, EveryLevelIsAnEvenChoiceOfTheFinerOne) {
  const NodeGraph graph = graphOf(test::makeComb(5), 0.02);
  const NodeLevels all = buildNodeLevels(graph);
  ASSERT_GE(all.levels.size(), 2U);
  const NodeGraph* finer = &graph;
  for (const NodeLevel& level : all.levels) {
    EXPECT_LT(2 * level.graph.nodeCount(), finer->nodeCount());
    ASSERT_EQ(level.finer_node.size(), level.graph.nodeCount());
    ASSERT_EQ(level.node_of_finer.size(), finer->nodeCount());
    for (std::size_t i = 0; i < level.graph.nodeCount(); ++i) {
      const NodeIndex there = level.finer_node[i];
      EXPECT_EQ(level.graph.positions[i], finer->positions[there.value]);
      EXPECT_EQ(level.node_of_finer[there.value], NodeIndex{i});
      EXPECT_FALSE(level.graph.edges.row(i).empty());
    }
    double mean = 0.0;
    for (const NodeGraph::Edge& edge : finer->edges.values) mean += static_cast<double>(edge.length);
    mean /= static_cast<double>(finer->edges.values.size());
    for (std::size_t i = 0; i < finer->nodeCount(); ++i) {
      const Eigen::Vector3d& chosen = level.graph.positions[level.node_of_finer[i].value];
      EXPECT_LE((finer->positions[i] - chosen).norm(), 2.0 * mean * (1.0 + 1e-6));
    }
    finer = &level.graph;
  }
  EXPECT_LE(finer->nodeCount(), NodeLevels::kCoarsest);
}

TEST(NodeLevels, ShellsStayApartAndAlive) {
  const SurfaceMesh two =
      test::makeJoined(test::makeComb(3), makeSphere(0.3, 1e-3), Eigen::Vector3d(0.0, 0.0, 4.0));
  const NodeGraph graph = graphOf(two, 0.04);
  const NodeLevels all = buildNodeLevels(graph);
  ASSERT_FALSE(all.levels.empty());
  EXPECT_EQ(all.levels.back().graph.shell_count, graph.shell_count);
}

TEST(NodeLevels, SmallGraphsHaveNone) {
  EXPECT_TRUE(buildNodeLevels(graphOf(makeBox({1, 1, 1}), 0.1)).levels.empty());
  EXPECT_TRUE(
      gridOf(BodyMesh("ball", makeSphere(1.0, 1e-4), BodyMeshOptions())).nodes().levels.levels.empty());
}

// Four times the nodes, four times the memory: of the levels, the body and a search's metric.
TEST(NodeLevels, MemoryIsLinearInTheNodes) {
  const auto bytes_per_node = [](double edge) {
    BodyMeshOptions options;
    options.max_edge_length = edge;
    const std::size_t before = allocated_bytes;
    const BodyMesh body("comb", test::makeComb(5), options);
    MeshMetricQuery query(gridOf(body).metric());
    (void)query.distanceWithin(NodeIndex{0}, NodeIndex{1}, 1.0);  // allocates
    return static_cast<double>(allocated_bytes - before) /
           static_cast<double>(gridOf(body).graph().nodeCount());
  };
  EXPECT_LT(bytes_per_node(0.01), 1.1 * bytes_per_node(0.02));
}

}  // namespace
}  // namespace concave_distance::node_levels_test
