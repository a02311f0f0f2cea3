#include "mesh/surface/mesh_topology.h"

#include <gtest/gtest.h>

#include <set>

#include "support/plain_shapes.h"

namespace concave_distance::mesh_topology_test {
namespace {

using Eigen::Vector3d;
using test::makeCuboid;
using test::makeSurface;

SurfaceMesh unitCuboid() {
  return makeCuboid(Vector3d::Zero(), Vector3d::Ones());
}

/// Two triangles share an edge when they share two vertices: brute force against the sorted edges.
bool shareEdge(const SurfaceMesh& mesh, std::size_t s, std::size_t t, std::size_t edge_of_s) {
  std::set<std::uint32_t> ends{mesh.triangles()[s][edge_of_s].value,
                               mesh.triangles()[s][(edge_of_s + 1) % 3].value};
  std::size_t found = 0;
  for (const NodeIndex node : mesh.triangles()[t]) {
    found += ends.count(node.value);
  }
  return found == 2;
}

TEST(MeshTopology, FindsTheNeighbourAcrossEveryEdgeOfABox) {
  const SurfaceMesh mesh = unitCuboid();
  const MeshTopology topology = buildMeshTopology(mesh);
  for (std::size_t s = 0; s < mesh.triangleCount(); ++s) {
    for (std::size_t k = 0; k < 3; ++k) {
      std::vector<std::uint32_t> across;
      for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
        if (t != s && shareEdge(mesh, s, t, k)) across.push_back(static_cast<std::uint32_t>(t));
      }
      ASSERT_EQ(across.size(), 1U);
      EXPECT_EQ(topology.triangle_across_edge[s][k].value, across.front());
    }
  }
}

TEST(MeshTopology, ListsTheTrianglesAndNeighboursOfEveryVertex) {
  const SurfaceMesh mesh = unitCuboid();
  const MeshTopology topology = buildMeshTopology(mesh);
  for (std::uint32_t v = 0; v < mesh.vertexCount(); ++v) {
    std::set<std::uint32_t> triangles;
    std::set<std::uint32_t> neighbours;
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
      const TriangleNodes& nodes = mesh.triangle(TriangleIndex{t});
      if (std::find(nodes.begin(), nodes.end(), NodeIndex{v}) == nodes.end()) continue;
      triangles.insert(t);
      for (const NodeIndex node : nodes) {
        if (node.value != v) neighbours.insert(node.value);
      }
    }
    const auto triangle_row = topology.triangles_of_vertex.row(v);
    const auto neighbour_row = topology.neighbours_of_vertex.row(v);
    ASSERT_EQ(triangle_row.size(), triangles.size());
    ASSERT_EQ(neighbour_row.size(), neighbours.size());
    std::size_t i = 0;
    for (const std::uint32_t t : triangles) {
      EXPECT_EQ(triangle_row[i++].value, t);
    }
    i = 0;
    for (const std::uint32_t n : neighbours) {
      EXPECT_EQ(neighbour_row[i++].value, n);
    }
  }
}

TEST(MeshTopology, TellsClosedShellsFromOpenOnes) {
  const SurfaceMesh box = unitCuboid();
  EXPECT_TRUE(buildMeshTopology(box).allShellsClosed());
  EXPECT_TRUE(buildMeshTopology(test::makeTurned(box)).allShellsClosed());
  EXPECT_FALSE(buildMeshTopology(test::makeOpened(box, 5)).allShellsClosed());

  const SurfaceMesh both =
      test::makeJoined(test::makeOpened(box, 0), makeCuboid(Vector3d::Constant(2), Vector3d::Constant(3)));
  const MeshTopology topology = buildMeshTopology(both);
  ASSERT_EQ(topology.shellCount(), 2U);
  EXPECT_FALSE(topology.shell_is_closed[0]);
  EXPECT_TRUE(topology.shell_is_closed[1]);
  EXPECT_EQ(topology.shell_of_triangle.front(), 0U);
  EXPECT_EQ(topology.shell_of_triangle.back(), 1U);
}

TEST(MeshTopology, OneTurnedTriangleOpensAShell) {
  std::vector<TriangleNodes> triangles = unitCuboid().triangles();
  std::swap(triangles[3][0], triangles[3][1]);
  const SurfaceMesh mesh(unitCuboid().vertices(), triangles, "box with a turned triangle");
  EXPECT_FALSE(buildMeshTopology(mesh).allShellsClosed());
}

TEST(MeshTopology, NamesTheFirstOtherTriangleAtANonManifoldEdge) {
  const SurfaceMesh book = makeSurface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}},
                                       {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}});
  const MeshTopology topology = buildMeshTopology(book);
  EXPECT_EQ(topology.triangle_across_edge[0][0], TriangleIndex{1});
  EXPECT_EQ(topology.triangle_across_edge[1][0], TriangleIndex{0});
  EXPECT_EQ(topology.triangle_across_edge[2][0], TriangleIndex{0});
  EXPECT_EQ(topology.triangle_across_edge[0][1], kNoTriangle);
  EXPECT_FALSE(topology.allShellsClosed());
}

TEST(MeshTopology, SolidsThatTouchAlongAnEdgeAreClosedEach) {
  std::vector<Vector3d> vertices = makeCuboid(Vector3d::Zero(), Vector3d::Ones()).vertices();
  const SurfaceMesh joined = test::makeJoined(makeCuboid(Vector3d::Zero(), Vector3d::Ones()),
                                              makeCuboid(Vector3d(1, 1, 0), Vector3d(2, 2, 1)));
  // Weld the second box's vertices 0 and 4 to the first one's 3 and 7: the edge they share.
  std::vector<TriangleNodes> triangles = joined.triangles();
  for (TriangleNodes& t : triangles) {
    for (NodeIndex& node : t) {
      if (node.value == 8) node = NodeIndex{3};
      if (node.value == 12) node = NodeIndex{7};
    }
  }
  const MeshTopology topology = buildMeshTopology(SurfaceMesh(joined.vertices(), triangles, "two boxes"));
  EXPECT_EQ(topology.shellCount(), 2U);
  EXPECT_TRUE(topology.allShellsClosed());
  EXPECT_NE(topology.shell_of_triangle.front(), topology.shell_of_triangle.back());
}

TEST(MeshTopology, IsolatedVerticesBelongToNoShell) {
  const SurfaceMesh mesh = makeSurface({{5, 5, 5}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{1, 2, 3}});
  const MeshTopology topology = buildMeshTopology(mesh);
  EXPECT_EQ(topology.shellCount(), 1U);
  EXPECT_EQ(topology.shell_of_triangle[0], 0U);
  EXPECT_TRUE(topology.triangles_of_vertex.row(0).empty());
}

TEST(MeshTopology, ASheetOnAnEdgeOfASolidIsAShellOfItsOwn) {
  std::vector<Vector3d> vertices = unitCuboid().vertices();
  std::vector<TriangleNodes> triangles = unitCuboid().triangles();
  vertices.emplace_back(2, 2, 0);
  triangles.push_back({NodeIndex{3}, NodeIndex{7}, NodeIndex{8}});
  const MeshTopology topology = buildMeshTopology(SurfaceMesh(vertices, triangles, "box with a fin"));
  ASSERT_EQ(topology.shellCount(), 2U);
  EXPECT_TRUE(topology.shell_is_closed[0]);
  EXPECT_FALSE(topology.shell_is_closed[1]);
  EXPECT_EQ(topology.triangle_of_shell[1], TriangleIndex{12});
}

TEST(MeshTopology, CopesWithTrianglesThatNameAVertexTwice) {
  const SurfaceMesh mesh = makeSurface({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 0, 1}, {2, 2, 2}});
  const MeshTopology topology = buildMeshTopology(mesh);
  EXPECT_EQ(topology.triangle_across_edge[0][0], TriangleIndex{1});
  EXPECT_EQ(topology.triangle_across_edge[1][0], kNoTriangle);
  EXPECT_EQ(topology.triangles_of_vertex.row(0).size(), 2U);
  EXPECT_EQ(topology.triangles_of_vertex.row(2).size(), 2U);
  EXPECT_EQ(topology.triangle_normals[1], Vector3d::Zero());
  EXPECT_EQ(topology.triangle_normals[2], Vector3d::Zero());
}

TEST(MeshTopology, NormalsOfABoxPointOutwards) {
  const SurfaceMesh mesh = unitCuboid();
  const MeshTopology topology = buildMeshTopology(mesh);
  for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
    const TriangleIndex triangle{t};
    const Vector3d centre =
        (mesh.corner(triangle, 0) + mesh.corner(triangle, 1) + mesh.corner(triangle, 2)) / 3.0;
    EXPECT_DOUBLE_EQ(topology.triangle_normals[t].norm(), 1.0);
    EXPECT_GT(topology.triangle_normals[t].dot(centre - Vector3d::Constant(0.5)), 0.4);
  }
  // By symmetry, whatever the diagonals: each face contributes a right angle to each of its corners.
  for (std::uint32_t v = 0; v < 8; ++v) {
    const Vector3d out = (mesh.vertex(NodeIndex{v}) - Vector3d::Constant(0.5)).normalized();
    EXPECT_LT((topology.vertex_normals[v] - out).norm(), 1e-15);
  }
}

TEST(MeshTopology, NormalOfANeedleKeepsItsDirection) {
  // 1 m long, 1e-8 m high, far from the origin's axes: the cross product of the two longer edges would
  // cancel.
  const Vector3d p(0.3, 0.4, 0.5);
  const Vector3d along = Vector3d(2, 1, 2) / 3.0;
  const Vector3d up = Vector3d(1, 2, -2) / 3.0;
  const SurfaceMesh mesh = makeSurface({p, p + along, p + along + 1e-8 * up}, {{0, 1, 2}});
  const Vector3d expected = along.cross(up);
  // Corners are rounded to 1e-16, a rotation of the short edge by 1e-8 about the long one.
  EXPECT_LT((buildMeshTopology(mesh).triangle_normals[0] - expected).norm(), 4e-8);
}

}  // namespace
}  // namespace concave_distance::mesh_topology_test
