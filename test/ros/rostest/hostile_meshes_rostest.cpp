// Hostile mesh files, and files that nobody may read, given to a running node: it refuses them and answers
// on.
#include <concave_distance/AddBody.h>
#include <concave_distance/GetDistance.h>
#include <concave_distance/ListBodies.h>
#include <concave_distance/RemoveBody.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "node_access.h"
#include "support/hostile_mesh_files.h"
#include "tf_player.h"

namespace concave_distance::hostile_meshes_rostest {
namespace {

namespace fs = std::filesystem;

// As in hostile_meshes.test.
const std::string kFolder = "/tmp/concave_distance_hostile_rostest";
const std::string kMeshes = kFolder + "/meshes";
constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
/// One file for each kind of harm; HostileMeshes.AreServedOrRefusedAndNothingElse imports them all.
constexpr const char* kHarms[] = {"nodes_1000000_deep.dae",        "unfolds_to_30_million_nodes.dae",
                                  "node_instances_itself.dae",     "four_billion_binary_vertices.ply",
                                  "facets_in_a_sparse_file.stl",   "material_library_is_a_fifo.obj",
                                  "coordinates_not_finite.obj",    "a_fifo.stl",
                                  "unfolds_to_1024_triangles.dae", "link_to_a_password_file.obj"};

AddBodyResponse addMesh(const std::string& resource) {
  AddBodyRequest request;
  request.name = "mesh";
  request.frame_id = "world";
  request.pose.orientation.w = 1.0;
  request.mesh_resource = resource;
  request.pair_with = {"box_a"};
  AddBodyResponse response = call<AddBody>(kNode + "add_body", request);
  if (response.success) {
    RemoveBodyRequest removal;
    removal.name = "mesh";
    EXPECT_TRUE(call<RemoveBody>(kNode + "remove_body", removal).success);
  }
  return response;
}

class HostileMeshesTest : public ::testing::Test {
 protected:
  static void TearDownTestSuite() {
    std::error_code ignored;
    fs::remove_all(kFolder, ignored);
  }
  HostileMeshesTest() {
    player.place("box_a", 0.0);
    player.place("box_b", 2.0);
    player.place("ball", 0.0, 3.0);
    EXPECT_TRUE(eventually([] { return answersRight(); }));
  }

  static bool answersRight() {
    GetDistanceRequest request;
    request.query.body_a = "box_a";
    request.query.body_b = "box_b";
    const auto response = call<GetDistance>(kNode + "get_distance", request);
    return response.success && std::abs(response.result.nearest.distance - 1.0) < kRounding;
  }

  TfPlayer player;
};

TEST_F(HostileMeshesTest, AreRefusedAndTheNodeAnswersOn) {
  const std::vector<test::HostileMesh> meshes = test::writeHostileMeshes(kMeshes);
  for (const char* harm : kHarms) {
    const auto mesh = std::find_if(meshes.begin(), meshes.end(),
                                   [&](const test::HostileMesh& file) { return file.name == harm; });
    ASSERT_NE(mesh, meshes.end()) << harm;
    const AddBodyResponse response = addMesh(mesh->path);
    EXPECT_EQ(response.success ? "served" : "refused", mesh->expectation) << harm << response.message;
    if (!response.success) {
      EXPECT_NE(response.message.find(harm), std::string::npos) << response.message;
    }
    ASSERT_TRUE(answersRight()) << harm;
  }
  EXPECT_EQ(call<ListBodies>(kNode + "list_bodies", {}).bodies.size(), 4U);
}

TEST_F(HostileMeshesTest, OutsideOfTheMeshRootsThereIsOneRefusal) {
  fs::create_directories(kMeshes);
  fs::create_directories(kFolder + "/secret/folder.obj");
  for (const char* file : {"/meshes/good.obj", "/secret/there.obj"})
    std::ofstream(kFolder + file) << kTriangle;
  std::error_code exists;
  fs::create_symlink("../secret/there.obj", kMeshes + "/link_out.obj", exists);
  fs::create_symlink("../secret/none.obj", kMeshes + "/link_to_none.obj", exists);
  EXPECT_TRUE(addMesh(kMeshes + "/good.obj").success);
  EXPECT_TRUE(addMesh("package://concave_distance/test/ros/rostest/meshes/two_blocks.obj").success);

  const auto refusal = [](const std::string& resource) {
    const std::string message = addMesh(resource).message;
    const std::size_t at = message.find(resource);
    EXPECT_NE(at, std::string::npos) << message;
    return at == std::string::npos ? message : message.substr(at + resource.size());
  };
  const std::string expected = refusal(kFolder + "/secret/there.obj");
  EXPECT_NE(expected.find("services read no mesh from there"), std::string::npos) << expected;
  EXPECT_NE(expected.find("~mesh_roots"), std::string::npos) << expected;
  for (const std::string& resource :
       {kFolder + "/secret/none.obj", kFolder + "/secret/folder.obj", kMeshes + "/../secret/there.obj",
        kMeshes + "/../secret/none.obj", kMeshes + "/link_out.obj", kMeshes + "/link_to_none.obj",
        "file://" + kFolder + "/secret/there.obj", std::string("/etc/passwd"), std::string("/no/such/file"),
        std::string("/dev/zero"), std::string("package://concave_distance/../../../../../../../etc/passwd"),
        std::string("package://roscpp/package.xml"), std::string("package://no_such_package/a.stl")}) {
    EXPECT_EQ(refusal(resource), expected) << resource;
  }
  EXPECT_TRUE(answersRight());
}

}  // namespace
}  // namespace concave_distance::hostile_meshes_rostest
