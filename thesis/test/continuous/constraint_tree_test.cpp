#include "thesis/src/continuous/constraint_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "concave_distance/base/error.h"
#include "mesh/surface/mesh_topology.h"
#include "support/temporary_folder.h"
#include "thesis/src/continuous/constraint_tree_file.h"
#include "thesis/src/continuous/piece_mesh.h"
#include "thesis/test/continuous/tree_shapes.h"

namespace concave_distance::constraint_tree_test {
namespace {

using test::boxPiece;
using test::boxTree;
using test::pitWithPost;

double volumeOf(const SurfaceMesh& mesh) {
  double volume = 0.0;
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
    const TriangleIndex triangle{t};
    volume += mesh.corner(triangle, 0).dot(mesh.corner(triangle, 1).cross(mesh.corner(triangle, 2))) / 6.0;
  }
  return volume;
}

std::string written(const ConstraintTree& tree) {
  std::ostringstream stream;
  writeConstraintTree(tree, stream);
  return stream.str();
}

ConstraintTree read(const std::string& text) {
  std::istringstream stream(text);
  return readConstraintTree(stream, "tree.yaml");
}

TEST(ConstraintTree, AlternatesLevelsAndNumbersChildrenAsTheThesisDoes) {
  const ConstraintTree tree = pitWithPost();
  ASSERT_EQ(tree.pieces().size(), 3u);
  EXPECT_EQ(tree.pieces()[0].level, 1);
  EXPECT_EQ(tree.pieces()[1].level, -2);
  EXPECT_EQ(tree.pieces()[2].level, 3);
  EXPECT_EQ(tree.pieces()[0].parent, kNoPiece);
  EXPECT_EQ(tree.objectId(2), (std::vector<std::uint32_t>{1, 1, 1}));
}

TEST(ConstraintTree, KeepsSiblingsTogether) {
  PieceDescription root = boxPiece({0, 0, 0}, {9, 9, 9});
  for (int i = 0; i < 3; ++i) root.children.push_back(boxPiece({2.0 * i, 0, 0}, {2.0 * i + 1, 1, 1}));
  root.children[1].children.push_back(boxPiece({2, 0, 0}, {2.5, 1, 1}));
  const ConstraintTree tree(root, {Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(9)}, 0.0, "siblings");
  EXPECT_EQ(tree.pieces()[0].first_child, 1u);
  EXPECT_EQ(tree.pieces()[0].child_count, 3u);
  EXPECT_EQ(tree.objectId(4), (std::vector<std::uint32_t>{1, 2, 1}));
  EXPECT_EQ(tree.pieces()[4].parent, 2u);
}

TEST(ConstraintTree, RefusesWhatIsNoTree) {
  const Eigen::AlignedBox3d box(Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones());
  EXPECT_THROW(ConstraintTree({}, box, 0.0, "no constraint"), Error);
  PieceDescription long_normal = boxPiece({0, 0, 0}, {1, 1, 1});
  long_normal.constraints[0].normal *= 2.0;
  EXPECT_THROW(ConstraintTree(long_normal, box, 0.0, "normal"), Error);
  const PieceDescription cube = boxPiece({0, 0, 0}, {1, 1, 1});
  EXPECT_THROW(ConstraintTree(cube, Eigen::AlignedBox3d(), 0.0, "empty box"), Error);
  EXPECT_THROW(ConstraintTree(cube, box, -1.0, "tolerance"), Error);
}

TEST(ConstraintTreeFile, ReadsWhatItWroteToTheBit) {
  PieceDescription root = pitWithPost().description();
  root.constraints[0] = {Eigen::Vector3d(1.0 / 3.0, 0.7, -0.1).normalized(), 1.0 / 7.0};
  const ConstraintTree tree(root, {Eigen::Vector3d(-0.1, 0, 1e-17), Eigen::Vector3d(4, M_PI, 4)}, 1e-12,
                            "tree");
  const ConstraintTree again = read(written(tree));
  EXPECT_EQ(written(again), written(tree));
  EXPECT_EQ(again.constraints()[0].normal, tree.constraints()[0].normal);
  EXPECT_EQ(again.boundingBox().max(), tree.boundingBox().max());
  EXPECT_EQ(again.pieces().back().level, 3);
}

TEST(ConstraintTreeFile, IsKeptOnDisk) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path("tree.yaml");
  writeConstraintTreeFile(pitWithPost(), path);
  EXPECT_EQ(written(readConstraintTreeFile(path)), written(pitWithPost()));
  EXPECT_THROW(readConstraintTreeFile(folder.path("missing.yaml")), Error);
}

TEST(ConstraintTreeFile, NamesTheLineOfWhatIsWrong) {
  const std::string right = written(pitWithPost());
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = right;
    text.replace(text.find(from), from.size(), to);
    return text;
  };
  for (const std::string& wrong :
       {changed("level: -2", "level: 2"), changed("object_id: [1, 1, 1]", "object_id: [1, 2, 1]"),
        changed("object_id: [1, 1]", "object_id: [1, 2]"), changed("- [1, 0, 0, -0]", "- [1, 0, 0]"),
        changed("- [1, 0, 0, -0]", "- [1, 0, zero, 0]"), changed("pieces", "parts"),
        changed("tolerance: ", "tolerance: much "), std::string("[")}) {
    try {
      read(wrong);
      ADD_FAILURE() << wrong;
    } catch (const Error& error) {
      EXPECT_EQ(error.where().rfind("tree.yaml", 0), 0u) << error.what();
    }
  }
}

TEST(PieceMesh, IsTheClosedPieceWithinItsAncestors) {
  const ConstraintTree tree = pitWithPost();
  const double volumes[] = {64.0, 12.0, 1.0};
  for (std::uint32_t i = 0; i < 3; ++i) {
    const SurfaceMesh mesh = pieceMesh(tree, i);
    EXPECT_TRUE(buildMeshTopology(mesh).allShellsClosed()) << i;
    EXPECT_NEAR(volumeOf(mesh), volumes[i], 1e-12) << i;
  }
}

TEST(PieceMesh, CutsSlantedConstraintsExactly) {
  PieceDescription root = boxPiece({0, 0, 0}, {1, 1, 1});
  const double s = 1.0 / std::sqrt(3.0);
  root.constraints.push_back({Eigen::Vector3d(-s, -s, -s), s});  // x + y + z <= 1
  const ConstraintTree tree(root, {Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones()}, 0.0, "corner");
  const SurfaceMesh mesh = pieceMesh(tree, 0);
  EXPECT_NEAR(volumeOf(mesh), 1.0 / 6.0, 1e-14);
  EXPECT_EQ(mesh.vertexCount(), 4u);
  EXPECT_TRUE(buildMeshTopology(mesh).allShellsClosed());
}

TEST(PieceMesh, SaysWhatIsNoPiece) {
  EXPECT_THROW(pieceMesh(boxTree({0, 0, 0}, {1, 1, 1}), 1), Error);
}

}  // namespace
}  // namespace concave_distance::constraint_tree_test
