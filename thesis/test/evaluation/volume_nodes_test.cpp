#include "thesis/src/evaluation/volume_nodes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "concave_distance/base/error.h"
#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "mesh/trees/triangle_tree.h"
#include "search/grid/body_grid.h"
#include "support/concave_shapes.h"
#include "thesis/src/evaluation/enumeration.h"
#include "thesis/src/grid/grid_nodes.h"

namespace concave_distance::volume_nodes_test {
namespace {

std::shared_ptr<const BodyMesh> bodyOf(SurfaceMesh surface, double edge) {
  BodyMeshOptions options;
  options.max_edge_length = edge;
  return std::make_shared<const BodyMesh>("body", std::move(surface), options);
}

SearchNodes surfaceNodes(const BodyMesh& body) {
  return makeGridNodes(body.surface(), body.options(), "body");
}

SearchNodes volumeOf(const BodyMesh& body, double lattice_edge) {
  return makeVolumeNodes(body, surfaceNodes(body), lattice_edge);
}

TEST(VolumeNodes, OfAUnitCubeAreItsSurfacesAndTheLatticeWithin) {
  const auto body = bodyOf(makeBox(Eigen::Vector3d::Ones()), 0.25);
  const NodeGraph surface = surfaceNodes(*body).graph;
  const SearchNodes volume = volumeOf(*body, 0.25);
  const std::size_t on_surface = surface.nodeCount();
  for (std::size_t i = 0; i < on_surface; ++i) {
    EXPECT_EQ(volume.graph.positions[i], surface.positions[i]);
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
  const auto body = bodyOf(test::makeComb(4), 0.1);
  const std::size_t on_surface = surfaceNodes(*body).graph.nodeCount();
  const SearchNodes volume = volumeOf(*body, 0.06);
  ASSERT_GT(volume.graph.nodeCount(), on_surface);
  EXPECT_EQ(volume.graph.shell_count, 1U);
  for (std::uint32_t i = 0; i < volume.graph.nodeCount(); ++i) {
    for (const NodeGraph::Edge& edge : volume.graph.edges.row(i)) {
      if (i < on_surface && edge.to.value < on_surface) continue;
      EXPECT_FALSE(segmentHits(body->tree(), body->surface(), volume.graph.positions[i],
                               volume.graph.positions[edge.to.value], 1e-3));
    }
  }
}

TEST(VolumeNodes, ChangeNothingAboutTheNearestPair) {
  const auto surface = bodyOf(test::makeComb(3), 0.15);
  const auto volume = bodyOf(test::makeComb(3), 0.15);
  volume->attach(std::make_unique<BodyGrid>(*volume, volumeOf(*volume, 0.08)));
  ASSERT_GT(gridOf(*volume).graph().nodeCount(), gridOf(*surface).graph().nodeCount());
  Eigen::Isometry3d pose(Eigen::AngleAxisd(0.4, Eigen::Vector3d(1.0, 2.0, 0.5).normalized()));
  pose.translation() = Eigen::Vector3d(0.3, 0.2, 1.7);
  EXPECT_EQ(enumerateNodePairs(*volume, *volume, pose).squared_distance,
            enumerateNodePairs(*surface, *surface, pose).squared_distance);
}

TEST(VolumeNodes, AnOpenSurfaceHasNone) {
  const SurfaceMesh box = makeBox(Eigen::Vector3d::Ones());
  std::vector<TriangleNodes> triangles = box.triangles();
  triangles.pop_back();
  const auto body = bodyOf({box.vertices(), triangles, "open box"}, 0.25);
  EXPECT_EQ(volumeOf(*body, 0.25).graph.nodeCount(), surfaceNodes(*body).graph.nodeCount());
}

TEST(VolumeNodes, RefuseALatticeWithoutASize) {
  const auto body = bodyOf(makeBox(Eigen::Vector3d::Ones()), 0.5);
  EXPECT_THROW(volumeOf(*body, 0.0), Error);
  EXPECT_THROW(volumeOf(*body, std::nan("")), Error);
}

}  // namespace
}  // namespace concave_distance::volume_nodes_test
