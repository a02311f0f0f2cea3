#include "thesis/src/evaluation/random_nodes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "concave_distance/base/error.h"
#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "search/grid/body_grid.h"
#include "support/concave_shapes.h"
#include "support/enumeration.h"
#include "thesis/src/evaluation/enumeration.h"

namespace concave_distance::random_nodes_test {
namespace {

SearchNodes nodesOf(const SurfaceMesh& surface, std::size_t count, bool vertices_and_edges,
                    std::uint64_t seed = 1) {
  RandomEngine engine(seed);
  RandomNodesOptions options;
  options.count = count;
  options.vertices_and_edges = vertices_and_edges;
  return makeRandomNodes(surface, buildMeshTopology(surface), options, engine, "test");
}

/// How far a point is from a triangle's plane, and whether it is within the triangle by its coordinates.
bool liesOn(const SurfaceMesh& surface, TriangleIndex t, const Eigen::Vector3d& point) {
  Eigen::Matrix3d corners;
  for (int k = 0; k < 3; ++k) corners.col(k) = surface.corner(t, k);
  const Eigen::Vector3d one = corners.col(1) - corners.col(0);
  const Eigen::Vector3d other = corners.col(2) - corners.col(0);
  const Eigen::Vector3d normal = one.cross(other);
  const Eigen::Vector3d from = point - corners.col(0);
  const double v = from.cross(other).dot(normal) / normal.squaredNorm();
  const double w = one.cross(from).dot(normal) / normal.squaredNorm();
  constexpr double kRounding = 1e-12;
  return std::abs(from.dot(normal)) <= kRounding && v >= -kRounding && w >= -kRounding &&
         v + w <= 1.0 + kRounding;
}

SurfaceMesh twoBoxes() {
  const SurfaceMesh box = makeBox(Eigen::Vector3d::Ones());
  std::vector<Eigen::Vector3d> vertices = box.vertices();
  std::vector<TriangleNodes> triangles = box.triangles();
  for (const Eigen::Vector3d& v : box.vertices()) vertices.push_back(v + Eigen::Vector3d(1.02, 0.0, 0.0));
  const auto count = static_cast<std::uint32_t>(box.vertexCount());
  for (const TriangleNodes& t : box.triangles()) {
    triangles.push_back(
        {NodeIndex{t[0].value + count}, NodeIndex{t[1].value + count}, NodeIndex{t[2].value + count}});
  }
  return {std::move(vertices), std::move(triangles), "two boxes"};
}

TEST(RandomNodes, LieOnTheTrianglesThatTheyName) {
  const SurfaceMesh comb = test::makeComb(4);
  for (const bool edges : {true, false}) {
    const SearchNodes nodes = nodesOf(comb, 700, edges);
    EXPECT_EQ(nodes.graph.nodeCount(), 700U);
    for (std::uint32_t i = 0; i < nodes.graph.nodeCount(); ++i) {
      EXPECT_TRUE(liesOn(comb, nodes.original_triangle_of_node[i], nodes.graph.positions[i])) << i;
    }
  }
}

TEST(RandomNodes, GiveEveryFaceWhatItsAreaIsWorth) {
  // Two faces each of 2, 4 and 8 square metres: 28 in all.
  const SurfaceMesh box = makeBox({1.0, 2.0, 4.0});
  const SearchNodes nodes = nodesOf(box, 1400, false);
  const Eigen::Vector3d half(0.5, 1.0, 2.0);
  const Eigen::Vector3d areas(8.0, 4.0, 2.0);
  for (int axis = 0; axis < 3; ++axis) {
    const auto on_face = std::count_if(
        nodes.graph.positions.begin(), nodes.graph.positions.end(),
        [&](const Eigen::Vector3d& p) { return std::abs(std::abs(p[axis]) - half[axis]) < 1e-12; });
    // Each of a face's two triangles, on two faces, is off by less than one.
    EXPECT_NEAR(static_cast<double>(on_face), 1400.0 * 2.0 * areas[axis] / 28.0, 4.0);
  }
}

TEST(RandomNodes, HaveEveryVertexAndDivideTheEdgesEvenly) {
  const SurfaceMesh box = makeBox(Eigen::Vector3d::Ones());
  const SearchNodes nodes = nodesOf(box, 600, true);
  std::size_t on_edges = 0;
  for (const Eigen::Vector3d& p : nodes.graph.positions) {
    int at_limit = 0;
    for (int axis = 0; axis < 3; ++axis) at_limit += std::abs(std::abs(p[axis]) - 0.5) < 1e-12 ? 1 : 0;
    on_edges += at_limit >= 2 ? 1 : 0;
  }
  // Spacing sqrt(2 / sqrt(3) * 6 / 600) = 0.1075: ten parts an edge; face diagonals are flat and not divided.
  EXPECT_EQ(on_edges, 8U + 12U * 9U);
  for (std::uint32_t v = 0; v < box.vertexCount(); ++v) {
    const NodeIndex node = nodes.graph_node_of_vertex[v];
    EXPECT_EQ(nodes.graph.positions[node.value], box.vertices()[v]);
  }
}

TEST(RandomNodes, AreNeighboursAlongTheSurfaceOnly) {
  const SearchNodes nodes = nodesOf(twoBoxes(), 600, false);
  EXPECT_EQ(nodes.graph.shell_count, 2U);
  // Nodes of the two boxes that face each other are 0.02 apart and yet no neighbours.
  for (std::uint32_t i = 0; i < nodes.graph.nodeCount(); ++i) {
    for (const NodeGraph::Edge& edge : nodes.graph.edges.row(i)) {
      EXPECT_EQ(nodes.graph.positions[i].x() < 0.51, nodes.graph.positions[edge.to.value].x() < 0.51);
    }
  }
  // The teeth of a comb: ways lead around the gaps, and everything hangs together.
  const SearchNodes comb = nodesOf(test::makeComb(4), 700, false);
  EXPECT_EQ(comb.graph.shell_count, 1U);
}

TEST(RandomNodes, EveryShellHasOne) {
  EXPECT_EQ(nodesOf(twoBoxes(), 1, false).graph.shell_count, 2U);
}

TEST(RandomNodes, OneSeedGivesOneSet) {
  const SurfaceMesh comb = test::makeComb(3);
  const SearchNodes one = nodesOf(comb, 300, true, 7);
  const SearchNodes same = nodesOf(comb, 300, true, 7);
  const SearchNodes other = nodesOf(comb, 300, true, 8);
  EXPECT_EQ(one.graph.positions, same.graph.positions);
  EXPECT_NE(one.graph.positions, other.graph.positions);
}

TEST(RandomNodes, AnswerNoLessThanTheSurfaces) {
  const auto body_of = [](std::uint64_t seed) {
    const auto body = std::make_shared<const BodyMesh>("comb", test::makeComb(3));
    body->attach(std::make_unique<BodyGrid>(*body, nodesOf(body->surface(), 500, true, seed)));
    return body;
  };
  const auto body_a = body_of(1);
  const auto body_b = body_of(2);
  const BodyMesh& a = *body_a;
  const BodyMesh& b = *body_b;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(0.3, 0.2, 1.7);
  const double exact = std::sqrt(test::enumerateTrianglePairs(a, b, pose).squared_distance);
  const double nodes = std::sqrt(enumerateNodePairs(a, b, pose).squared_distance);
  EXPECT_GE(nodes, exact);
  EXPECT_LE(nodes, exact + gridOf(a).nodes().max_edge_length + gridOf(b).nodes().max_edge_length);
}

TEST(RandomNodes, NoneAtAllAreRefused) {
  EXPECT_THROW(nodesOf(makeBox(Eigen::Vector3d::Ones()), 0, true), Error);
}

}  // namespace
}  // namespace concave_distance::random_nodes_test
