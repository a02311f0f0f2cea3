#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>

#include "concave_distance/mesh/import/export_mesh.h"
#include "support/concave_shapes.h"
#include "support/plain_shapes.h"
#include "support/temporary_folder.h"
#include "thesis/test/support/partition_checks.h"
#include "thesis/test/support/read_pieces.h"

namespace concave_distance::thesis_tool_convex_test {
namespace {

/// The program as a user runs it.
class ThesisToolConvex : public testing::Test {
 protected:
  int run(const std::string& arguments) const {
    const std::string command = std::string(CONCAVE_DISTANCE_THESIS_TOOL) + " " + arguments + " > " +
                                folder.path("out") + " 2> " + folder.path("errors");
    return WEXITSTATUS(std::system(command.c_str()));
  }

  test::TemporaryFolder folder;
};

TEST_F(ThesisToolConvex, PartitionWritesPiecesThatAreTheBody) {
  const SurfaceMesh comb = test::makeComb(4);
  exportMesh(comb, folder.path("comb.obj"));
  EXPECT_EQ(run("partition " + folder.path("comb.obj") + " " + folder.path("pieces.obj")), 0);
  EXPECT_NE(test::contentOf(folder.path("out")).find("reflex edges: 6, shells: 1\n"), std::string::npos);
  // Import passes through single precision.
  const std::string path = folder.path("comb.obj");
  test::expectSameSolid(test::readPieces(folder.path("pieces.obj")),
                        repairMesh(importMesh(path), {}, path).mesh, 1000);
}

TEST_F(ThesisToolConvex, HullWritesAClosedMeshAroundTheBody) {
  const SurfaceMesh comb = test::makeComb(4);
  exportMesh(comb, folder.path("comb.obj"));
  EXPECT_EQ(run("hull " + folder.path("comb.obj") + " " + folder.path("hull.ply")), 0);
  const std::string path = folder.path("hull.ply");
  const SurfaceMesh hull = repairMesh(importMesh(path), {}, path).mesh;
  EXPECT_TRUE(buildMeshTopology(hull).allShellsClosed());
  EXPECT_TRUE(hull.boundingBox().isApprox(comb.boundingBox(), 1e-6));
  EXPECT_GT(test::volumeOf(hull), test::volumeOf(comb));
}

TEST_F(ThesisToolConvex, AnOpenMeshIsRefusedByName) {
  folder.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n");
  EXPECT_EQ(run("partition " + folder.path("open.obj") + " " + folder.path("pieces.obj")), 1);
  const std::string errors = test::contentOf(folder.path("errors"));
  EXPECT_NE(errors.find("open.obj"), std::string::npos) << errors;
  EXPECT_NE(errors.find("border"), std::string::npos) << errors;
}

TEST_F(ThesisToolConvex, MoreReflexEdgesThanAllowedAreRefused) {
  exportMesh(test::makeComb(4), folder.path("comb.obj"));
  EXPECT_EQ(
      run("partition --reflex-edge-limit 5 " + folder.path("comb.obj") + " " + folder.path("pieces.obj")), 1);
  EXPECT_NE(test::contentOf(folder.path("errors")).find("6 reflex edges"), std::string::npos);
}

}  // namespace
}  // namespace concave_distance::thesis_tool_convex_test
