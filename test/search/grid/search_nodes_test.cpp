#include "search/grid/search_nodes.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/random_engine.h"
#include "concave_distance/base/error.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "support/any_surface.h"
#include "support/concave_shapes.h"
#include "support/mesh_measures.h"

namespace concave_distance::search_nodes_test {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

SearchNodes nodesOf(const SurfaceMesh& surface, std::optional<double> max_edge_length) {
  BodyMeshOptions options;
  options.max_edge_length = max_edge_length;
  return makeSearchNodes(surface, options, "body");
}

RC_GTEST_PROP(SearchNodes, LieOnTheirTriangleAndNowhereFarApart, ()) {
  const SurfaceMesh surface = *test::anySurface();
  const double limit = *rc::gen::inRange(10, 100) / 100.0 * surface.diameter();
  const SearchNodes nodes = nodesOf(surface, limit);
  RC_ASSERT(!nodes.thinned());
  RC_ASSERT(std::equal(surface.vertices().begin(), surface.vertices().end(), nodes.graph.positions.begin()));
  for (std::uint32_t node = 0; node < nodes.graph.nodeCount(); ++node) {
    const TriangleIndex original = nodes.originalTriangle(NodeIndex{node});
    RC_ASSERT(test::distanceToTriangle(nodes.graph.positions[node], surface.corner(original, 0),
                                       surface.corner(original, 1), surface.corner(original, 2)) <=
              32.0 * kEpsilon * (surface.diameter() + 1.0));
    for (const NodeGraph::Edge& edge : nodes.graph.edges.row(node)) {
      RC_ASSERT(static_cast<double>(edge.length) <= limit * (1.0 + 0x1.0p-22));
    }
  }
}

// Level `nodes` overestimates by at most (h_A + h_B) / sqrt(3): each body contributes h / sqrt(3).
RC_GTEST_PROP(SearchNodes, AreWithinAnEdgeOverRootThreeOfEveryPoint, ()) {
  const SurfaceMesh surface = *test::anySurface();
  const double limit = *rc::gen::inRange(10, 50) / 100.0 * surface.diameter();
  const SearchNodes nodes = nodesOf(surface, limit);
  RandomEngine engine(*rc::gen::arbitrary<std::uint64_t>());
  for (int i = 0; i < 20; ++i) {
    const TriangleIndex t{uniformIndex(engine, static_cast<std::uint32_t>(surface.triangleCount()))};
    const double u = uniformUnit(engine);
    const double v = uniformUnit(engine) * (1.0 - u);
    const Eigen::Vector3d point =
        (1.0 - u - v) * surface.corner(t, 0) + u * surface.corner(t, 1) + v * surface.corner(t, 2);
    double nearest = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& node : nodes.graph.positions) {
      nearest = std::min(nearest, (node - point).norm());
    }
    RC_ASSERT(nearest <= limit / std::sqrt(3.0) * (1.0 + 1e-12));
  }
}

TEST(SearchNodes, OfAnAutomaticGridAreAsManyAsTheSearchWants) {
  const std::size_t most = BodyMeshOptions().search_node_limit;
  for (const SurfaceMesh& surface : {makeBox({1.0, 0.7, 0.4}), test::makeComb(5), makeSphere(1.0, 1e-4)}) {
    const SearchNodes nodes = nodesOf(surface, std::nullopt);
    EXPECT_LE(nodes.graph.nodeCount(), most);
    EXPECT_GE(nodes.graph.nodeCount(), most / 4);
    ASSERT_EQ(nodes.original_triangle_of_node.size(), nodes.graph.nodeCount());
    for (std::uint32_t vertex = 0; vertex < surface.vertexCount(); ++vertex) {
      const NodeIndex node = nodes.graphNode(NodeIndex{vertex});
      ASSERT_LT(node.value, nodes.graph.nodeCount());
      if (!nodes.thinned()) {
        EXPECT_EQ(nodes.graph.positions[node.value], surface.vertex(NodeIndex{vertex}));
      }
    }
  }
}

TEST(SearchNodes, RefuseLengthsAndMeshesTheyCannotBeMadeWith) {
  const SurfaceMesh box = makeBox({1.0, 1.0, 1.0});
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity(), 1e-12}) {
    EXPECT_THROW(nodesOf(box, bad), Error) << bad;
  }
  const SurfaceMesh folded(
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
      {{NodeIndex{0}, NodeIndex{1}, NodeIndex{2}}, {NodeIndex{0}, NodeIndex{1}, NodeIndex{1}}}, "folded");
  EXPECT_THROW(nodesOf(folded, 0.1), Error);
}

}  // namespace
}  // namespace concave_distance::search_nodes_test
