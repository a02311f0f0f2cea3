#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>

#include "support/temporary_folder.h"
#include "support/thesis_scenes.h"
#include "thesis/src/continuous/constraint_tree_file.h"

namespace concave_distance::thesis_tool_tree_test {
namespace {

/// The program as a user runs it.
class ThesisToolTree : public testing::Test {
 protected:
  int run(const std::string& arguments) const {
    const std::string command = std::string(CONCAVE_DISTANCE_THESIS_TOOL) + " tree " + arguments + " > " +
                                folder.path("out") + " 2> " + folder.path("errors");
    return WEXITSTATUS(std::system(command.c_str()));
  }

  test::TemporaryFolder folder;
};

TEST_F(ThesisToolTree, WritesTheTreeAndItsPiecesAndTellsWhereItFellBack) {
  EXPECT_EQ(run(test::thesisFile("grooved_cylinder.stl") + " " + folder.path("tree.yaml") + " --pieces " +
                folder.path("pieces.obj")),
            0);
  const std::string out = test::contentOf(folder.path("out"));
  EXPECT_NE(out.find("level -2: 1 pieces, 2 constraints"), std::string::npos) << out;
  EXPECT_NE(out.find("2 convex pieces at level 3"), std::string::npos) << out;
  EXPECT_EQ(readConstraintTreeFile(folder.path("tree.yaml")).pieces().size(), 4u);
  const TriangleSoup pieces = importMesh(folder.path("pieces.obj"));
  EXPECT_GT(pieces.triangles.size(), 100u);
  EXPECT_NE(test::contentOf(folder.path("pieces.obj")).find("o level_3_piece_1_1_2\n"), std::string::npos);
}

TEST_F(ThesisToolTree, RefusesAnOpenMeshByName) {
  folder.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n");
  EXPECT_EQ(run(folder.path("open.obj") + " " + folder.path("tree.yaml")), 1);
  EXPECT_NE(test::contentOf(folder.path("errors")).find("not closed"), std::string::npos);
}

}  // namespace
}  // namespace concave_distance::thesis_tool_tree_test
