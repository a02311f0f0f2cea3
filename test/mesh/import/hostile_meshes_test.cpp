// Every file of test/faults/hostile_meshes.py: served or refused, as the file says, and this program goes on.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "concave_distance/base/error.h"
#include "concave_distance/mesh/import/import_mesh.h"
#include "support/hostile_mesh_files.h"
#include "support/temporary_folder.h"

namespace concave_distance::hostile_meshes_test {
namespace {

TEST(HostileMeshes, AreServedOrRefusedAndNothingElse) {
  const test::TemporaryFolder folder;
  const std::vector<test::HostileMesh> meshes = test::writeHostileMeshes(folder.path());
  ASSERT_GE(meshes.size(), 80U);
  for (const test::HostileMesh& mesh : meshes) {
    MeshImportLimits limits;
    limits.memory = 500'000'000;
    // What may be refused need not be given time.
    if (mesh.expectation != "served") limits.seconds = 3.0;
    try {
      const TriangleSoup soup = importMesh(mesh.path, Eigen::Vector3d::Ones(), limits);
      EXPECT_NE(mesh.expectation, "refused") << mesh.name << ": " << soup.triangles.size() << " triangles";
    } catch (const Error& error) {
      EXPECT_NE(mesh.expectation, "served") << error.what();
      EXPECT_EQ(error.where(), mesh.path);
      EXPECT_FALSE(error.remedy().empty()) << error.what();
      EXPECT_LT(std::string(error.what()).size(), 1000U) << error.what();
    }
  }
}

}  // namespace
}  // namespace concave_distance::hostile_meshes_test
