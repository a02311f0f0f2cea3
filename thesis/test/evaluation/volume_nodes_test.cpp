#include "thesis/src/evaluation/volume_nodes.h"
#include "mesh/body_mesh_parts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "concave_distance/base/error.h"
#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "support/concave_shapes.h"
#include "thesis/src/evaluation/enumeration.h"

namespace concave_distance::volume_nodes_test {
namespace {

BodyMeshParts partsOf(SurfaceMesh surface, double edge) {
  BodyMeshOptions options;
  options.max_edge_length = edge;
  return makeBodyMeshParts("body", std::move(surface), options);
}

SearchNodes volumeOf(const BodyMeshParts& parts, double lattice_edge) {
  return makeVolumeNodes(parts.surface, parts.topology, parts.tree, parts.nodes, lattice_edge);
}

TEST(VolumeNodes, OfAUnitCubeAreItsSurfacesAndTheLatticeWithin) {
  const BodyMeshParts parts = partsOf(makeBox(Eigen::Vector3d::Ones()), 0.25);
  const SearchNodes volume = volumeOf(parts, 0.25);
  const std::size_t on_surface = parts.nodes.graph.nodeCount();
  for (std::size_t i = 0; i < on_surface; ++i) {
    EXPECT_EQ(volume.graph.positions[i], parts.nodes.graph.positions[i]);
  }
  // Corners of cubes within: 3^3, a quarter and more below the surface; centres: 4^3, of which the outer ones
  // are as far below it as lattice nodes keep off its nodes, and may stand below one.
  EXPECT_GE(volume.graph.nodeCount() - on_surface, 27U + 8U);
  EXPECT_LE(volume.graph.nodeCount() - on_surface, 27U + 64U);
  for (std::size_t i = on_surface; i < volume.graph.nodeCount(); ++i) {
    EXPECT_LT(volume.graph.positions[i].cwiseAbs().maxCoeff(), 0.5);
  }
  EXPECT_EQ(volume.graph.shell_count, 1U);
}

TEST(VolumeNodes, AreNeighboursThroughTheBodyOnly) {
  const BodyMeshParts parts = partsOf(test::makeComb(4), 0.1);
  const SearchNodes volume = volumeOf(parts, 0.06);
  ASSERT_GT(volume.graph.nodeCount(), parts.nodes.graph.nodeCount());
  EXPECT_EQ(volume.graph.shell_count, 1U);
  for (std::uint32_t i = 0; i < volume.graph.nodeCount(); ++i) {
    for (const NodeGraph::Edge& edge : volume.graph.edges.row(i)) {
      if (i < parts.nodes.graph.nodeCount() && edge.to.value < parts.nodes.graph.nodeCount()) continue;
      EXPECT_FALSE(segmentHits(parts.tree, parts.surface, volume.graph.positions[i],
                               volume.graph.positions[edge.to.value], 1e-3));
    }
  }
}

TEST(VolumeNodes, ChangeNothingAboutTheNearestPair) {
  const auto body_of = [](bool with_volume) {
    BodyMeshParts parts = partsOf(test::makeComb(3), 0.15);
    if (with_volume) parts.nodes = volumeOf(parts, 0.08);
    return BodyMesh(std::move(parts), {});
  };
  const BodyMesh surface = body_of(false);
  const BodyMesh volume = body_of(true);
  ASSERT_GT(volume.graph().nodeCount(), surface.graph().nodeCount());
  Eigen::Isometry3d pose(Eigen::AngleAxisd(0.4, Eigen::Vector3d(1.0, 2.0, 0.5).normalized()));
  pose.translation() = Eigen::Vector3d(0.3, 0.2, 1.7);
  EXPECT_EQ(enumerateNodePairs(volume, volume, pose).squared_distance,
            enumerateNodePairs(surface, surface, pose).squared_distance);
}

TEST(VolumeNodes, AnOpenSurfaceHasNone) {
  const SurfaceMesh box = makeBox(Eigen::Vector3d::Ones());
  std::vector<TriangleNodes> triangles = box.triangles();
  triangles.pop_back();
  const BodyMeshParts parts = partsOf({box.vertices(), triangles, "open box"}, 0.25);
  EXPECT_EQ(volumeOf(parts, 0.25).graph.nodeCount(), parts.nodes.graph.nodeCount());
}

TEST(VolumeNodes, RefuseALatticeWithoutASize) {
  const BodyMeshParts parts = partsOf(makeBox(Eigen::Vector3d::Ones()), 0.5);
  EXPECT_THROW(volumeOf(parts, 0.0), Error);
  EXPECT_THROW(volumeOf(parts, std::nan("")), Error);
}

}  // namespace
}  // namespace concave_distance::volume_nodes_test
