// Every file of test/faults/hostile_meshes.py: served or refused, as the file says, and this program goes on.
#include <gtest/gtest.h>

#include <cstdio>
#include <sstream>
#include <string>
#include <vector>

#include "concave_distance/base/error.h"
#include "concave_distance/mesh/import/import_mesh.h"
#include "support/temporary_folder.h"

namespace concave_distance {
namespace {

struct HostileMesh {
  std::string expectation;
  std::string name;
  std::string path;
};

std::vector<HostileMesh> writeHostileMeshes(const std::string& folder) {
  const std::string command =
      "python3 '" CONCAVE_DISTANCE_SOURCE_DIR "/test/faults/hostile_meshes.py' '" + folder + "'";
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return {};
  std::string output;
  char buffer[4096];
  while (const std::size_t size = fread(buffer, 1, sizeof buffer, pipe)) output.append(buffer, size);
  EXPECT_EQ(pclose(pipe), 0) << command;
  std::vector<HostileMesh> meshes;
  std::istringstream lines(output);
  for (HostileMesh mesh; lines >> mesh.expectation >> mesh.name >> mesh.path;) meshes.push_back(mesh);
  return meshes;
}

TEST(HostileMeshes, AreServedOrRefusedAndNothingElse) {
  const test::TemporaryFolder folder;
  const std::vector<HostileMesh> meshes = writeHostileMeshes(folder.path());
  ASSERT_GE(meshes.size(), 80U);
  for (const HostileMesh& mesh : meshes) {
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
}  // namespace concave_distance
