#include "thesis/src/partition/convex_partition.h"

#include <gtest/gtest.h>

#include "concave_distance/base/error.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "support/concave_shapes.h"
#include "support/plain_shapes.h"
#include "support/thesis_scenes.h"
#include "thesis/test/support/partition_checks.h"
#include "thesis/test/support/read_pieces.h"

namespace concave_distance::convex_partition_test {
namespace {

SurfaceMesh together(const SurfaceMesh& a, const SurfaceMesh& b, bool turn_b = false) {
  std::vector<Eigen::Vector3d> vertices = a.vertices();
  vertices.insert(vertices.end(), b.vertices().begin(), b.vertices().end());
  std::vector<TriangleNodes> triangles = a.triangles();
  const auto shift = static_cast<std::uint32_t>(a.vertexCount());
  for (TriangleNodes t : b.triangles()) {
    for (NodeIndex& node : t) node.value += shift;
    if (turn_b) std::swap(t[1], t[2]);
    triangles.push_back(t);
  }
  return SurfaceMesh(std::move(vertices), std::move(triangles), "two shells");
}

class ThesisBodies : public testing::TestWithParam<const char*> {};

TEST_P(ThesisBodies, ArePartitionedIntoConvexPiecesThatAreTheBody) {
  const SurfaceMesh mesh = test::loadSurface(std::string("thesis/") + GetParam() + ".stl");
  const PartitionedBody body = partitionMesh(mesh, GetParam());
  test::expectConvex(body.partition);
  test::expectSameSolid(body.partition, mesh, 3000);
  EXPECT_EQ(body.report.dropped_slivers, 0u);
  EXPECT_EQ(body.report.shells, 1u);
}

INSTANTIATE_TEST_SUITE_P(Partition, ThesisBodies,
                         testing::Values("box", "notched_box", "semi_extruded", "grooved_cylinder", "fixture",
                                         "battery"));

TEST(HandPartition, HasTheThesissFourteenTimesNinePiecesWhichAreTheBodies) {
  const ConvexPartition battery = test::readPieces(test::thesisFile("battery_pieces.obj"));
  const ConvexPartition fixture = test::readPieces(test::thesisFile("fixture_pieces.obj"));
  EXPECT_EQ(battery.pieces.size(), 14u);
  EXPECT_EQ(fixture.pieces.size(), 9u);
  for (const ConvexPartition* partition : {&battery, &fixture}) test::expectConvex(*partition);
  test::expectSameSolid(battery, test::loadSurface("thesis/battery.stl"), 6000);
  test::expectSameSolid(fixture, test::loadSurface("thesis/fixture.stl"), 6000);
}

TEST(ConvexPartition, ABoxIsOnePieceAndItsTrianglesSixFacets) {
  const PartitionedBody body = partitionMesh(makeBox({1.0, 2.0, 3.0}), "box");
  ASSERT_EQ(body.partition.pieces.size(), 1u);
  EXPECT_EQ(body.partition.pieces[0].facets.size(), 6u);
  EXPECT_EQ(body.partition.pieces[0].vertices.size(), 8u);
  EXPECT_EQ(body.report.reflex_edges, 0u);
}

TEST(ConvexPartition, ACombNeedsAPieceAToothAndItsBack) {
  const SurfaceMesh comb = test::makeComb(5);
  EXPECT_EQ(countReflexEdges(comb), 8u);
  const PartitionedBody body = partitionMesh(comb, "comb");
  EXPECT_GE(body.partition.pieces.size(), 6u);
  test::expectConvex(body.partition);
  test::expectSameSolid(body.partition, comb, 2000);
}

TEST(ConvexPartition, ALinkOfARobotIsPartitionedExactly) {
  const SurfaceMesh link = test::loadSurface("wam/wam5_collision.stl");
  const PartitionedBody body = partitionMesh(link, "wam5");
  test::expectConvex(body.partition);
  test::expectSameSolid(body.partition, link, 2000);
}

TEST(ConvexPartition, OfOverlappingShellsTheUnionIsPartitioned) {
  const SurfaceMesh two =
      together(test::makeCuboid({0, 0, 0}, {1, 1, 1}), test::makeCuboid({0.5, 0.5, 0.5}, {2, 2, 2}));
  const PartitionedBody body = partitionMesh(two, "two boxes");
  EXPECT_EQ(body.report.shells, 2u);
  EXPECT_NEAR(test::volumeOf(body.partition), 1.0 + 3.375 - 0.125, 1e-12);
}

TEST(ConvexPartition, AShellThatTurnsInwardsIsAHollow) {
  const SurfaceMesh hollow =
      together(test::makeCuboid({0, 0, 0}, {3, 3, 3}), test::makeCuboid({1, 1, 1}, {2, 2, 2}), true);
  const PartitionedBody body = partitionMesh(hollow, "hollow box");
  EXPECT_NEAR(test::volumeOf(body.partition), 26.0, 1e-12);
  for (const ConvexPiece& piece : body.partition.pieces) EXPECT_LT(depth(piece, {1.5, 1.5, 1.5}), 0.0);
}

std::string errorOf(const SurfaceMesh& mesh, const PartitionOptions& options = {}) {
  try {
    partitionMesh(mesh, "body", options);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(ConvexPartition, WhatHasNoInsideIsRefused) {
  const SurfaceMesh box = makeBox({1, 1, 1});
  std::vector<TriangleNodes> open = box.triangles();
  open.pop_back();
  EXPECT_NE(errorOf(SurfaceMesh(box.vertices(), open, "open")).find("border"), std::string::npos);
  std::vector<TriangleNodes> turned = box.triangles();
  for (TriangleNodes& t : turned) std::swap(t[1], t[2]);
  EXPECT_NE(errorOf(SurfaceMesh(box.vertices(), turned, "turned")).find("no volume"), std::string::npos);
}

TEST(ConvexPartition, ASurfaceThatCrossesItselfIsRefused) {
  std::vector<Eigen::Vector3d> vertices = makeBox({1, 1, 1}).vertices();
  const SurfaceMesh box = makeBox({1, 1, 1});
  vertices[0] = Eigen::Vector3d(0.1, 0.2, 1.5);  // through the opposite face
  const std::string error = errorOf(SurfaceMesh(vertices, box.triangles(), "crossed"));
  EXPECT_NE(error.find("crosses itself"), std::string::npos) << error;
}

TEST(ConvexPartition, MoreReflexEdgesThanTheLimitAreRefusedWithTheirCount) {
  PartitionOptions options;
  options.reflex_edge_limit = 7;
  const std::string error = errorOf(test::makeComb(5), options);
  EXPECT_NE(error.find("8 reflex edges"), std::string::npos) << error;
}

}  // namespace
}  // namespace concave_distance::convex_partition_test
