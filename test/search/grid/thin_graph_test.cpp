#include "search/grid/thin_graph.h"

#include <gtest/gtest.h>

#include <set>

#include "concave_distance/mesh/surface/primitives.h"
#include "mesh/surface/refine_mesh.h"
#include "support/concave_shapes.h"

namespace concave_distance::thin_graph_test {
namespace {

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
      test::makeUnion(makeBox({1.0, 1.0, 1.0}), makeBox({0.1, 0.1, 0.1}), {3.0, 0.0, 0.0});
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
}  // namespace concave_distance::thin_graph_test
