#include "thesis/src/partition/convex_piece.h"

#include <gtest/gtest.h>

#include <fstream>

#include "concave_distance/base/error.h"
#include "support/temporary_folder.h"
#include "support/thesis_scenes.h"
#include "thesis/src/partition/convex_hull.h"
#include "thesis/src/partition/piece_file.h"
#include "thesis/test/support/partition_checks.h"
#include "thesis/test/support/read_pieces.h"

namespace concave_distance::convex_piece_test {
namespace {

ConvexPiece unitCube() {
  std::vector<Eigen::Vector3d> corners;
  for (int k = 0; k < 8; ++k) corners.emplace_back(k & 1, (k >> 1) & 1, (k >> 2) & 1);
  return convexHull(corners, "cube");
}

TEST(ConvexPiece, TheHullOfACubeHasSixSquareFacets) {
  std::vector<Eigen::Vector3d> points = unitCube().vertices;
  // On facets, on edges and inside: no corners of the hull.
  points.insert(points.end(), {{0.5, 0.5, 0.0}, {0.5, 0.0, 0.0}, {0.3, 0.4, 0.5}, {1.0, 1.0, 0.25}});
  const ConvexPiece cube = convexHull(points, "cube");
  EXPECT_EQ(cube.vertices.size(), 8u);
  ASSERT_EQ(cube.facets.size(), 6u);
  for (const auto& facet : cube.facets) EXPECT_EQ(facet.size(), 4u);
  EXPECT_DOUBLE_EQ(volume(cube), 1.0);
  EXPECT_DOUBLE_EQ(cube.radius, std::sqrt(0.75));
}

TEST(ConvexPiece, DepthIsTheLeastHalfSpaceAndSupportTheFarthestCorner) {
  const ConvexPiece cube = unitCube();
  EXPECT_DOUBLE_EQ(depth(cube, {0.5, 0.5, 0.9}), 0.1);
  EXPECT_DOUBLE_EQ(depth(cube, {0.5, 0.5, 1.25}), -0.25);
  EXPECT_DOUBLE_EQ(support(cube, Eigen::Vector3d(1.0, 1.0, 0.0).normalized()), std::sqrt(2.0));
}

TEST(ConvexPiece, PointsOfOnePlaneHaveNoHull) {
  EXPECT_THROW(convexHull({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}}, "square"), Error);
  EXPECT_THROW(convexHull({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {2, 2, 2}}, "line"), Error);
  EXPECT_THROW(convexHull({}, "nothing"), Error);
}

TEST(ConvexPiece, WhatIsNotConvexIsRefused) {
  ConvexPiece cube = unitCube();
  std::vector<Eigen::Vector3d> bent = cube.vertices;
  bent[0] += 0.1 * (cube.centre - bent[0]);
  EXPECT_THROW(makeConvexPiece(bent, cube.facets, "bent"), Error);
  auto inside_out = cube.facets;
  for (auto& facet : inside_out) std::reverse(facet.begin(), facet.end());
  EXPECT_THROW(makeConvexPiece(cube.vertices, inside_out, "inside out"), Error);
  auto no_corner = cube.facets;
  no_corner[0][0] = 8;
  EXPECT_THROW(makeConvexPiece(cube.vertices, no_corner, "index"), Error);
}

TEST(PieceFile, WhatIsWrittenIsReadBackBitForBit) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path("pieces.obj");
  const ConvexPartition hand = test::readPieces(test::thesisFile("battery_pieces.obj"));
  writePieces(hand, path);
  const ConvexPartition again = test::readPieces(path);
  ASSERT_EQ(again.pieces.size(), hand.pieces.size());
  for (std::size_t p = 0; p < hand.pieces.size(); ++p) {
    EXPECT_EQ(again.pieces[p].vertices, hand.pieces[p].vertices);
    EXPECT_EQ(again.pieces[p].facets, hand.pieces[p].facets);
    EXPECT_LT((again.pieces[p].normals - hand.pieces[p].normals).norm(), 1e-15);
  }
}

TEST(PieceFile, FaultsNameTheFileAndTheLine) {
  const test::TemporaryFolder folder;
  const auto error_of = [&folder](const std::string& text) {
    const std::string path = folder.path("faulty.obj");
    std::ofstream(path) << text;
    try {
      test::readPieces(path);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_NE(error_of("v 0 0 0\n").find("line 1"), std::string::npos);
  EXPECT_NE(error_of("o a\nv 0 0\n").find("line 2"), std::string::npos);
  EXPECT_NE(error_of("o a\nv 0 0 0\nf 1 2 3\n").find("line 3"), std::string::npos);
  EXPECT_NE(error_of("# nothing\n").find("no piece"), std::string::npos);
  EXPECT_NE(error_of("o flat\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").find("piece flat"), std::string::npos);
  EXPECT_THROW(test::readPieces(folder.path("missing.obj")), Error);
  EXPECT_THROW(writePieces({}, folder.path("no_such_folder/pieces.obj")), Error);
}

}  // namespace
}  // namespace concave_distance::convex_piece_test
