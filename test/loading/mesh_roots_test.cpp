#include "concave_distance/loading/mesh_roots.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>

#include "concave_distance/base/error.h"
#include "concave_distance/loading/load_scene.h"
#include "mesh/import/mesh_file.h"
#include "support/temporary_folder.h"

namespace concave_distance::mesh_roots_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

// A package `arm`, a folder `meshes` and what must not be told of: files, folders, links to both.
class MeshRootsTest : public testing::Test {
 protected:
  MeshRootsTest() {
    folder.write("packages/arm/meshes/link.obj", kTriangle);
    folder.write("packages/other/meshes/link.obj", kTriangle);
    folder.write("meshes/deep/cup.obj", kTriangle);
    folder.write("secret/there.obj", kTriangle);
    fs::create_directory(folder.path("secret/folder.obj"));
    mkfifo(folder.path("secret/fifo.obj").c_str(), 0600);
    fs::create_directory_symlink("../secret", folder.path("meshes/link_out"));
    fs::create_symlink("../secret/there.obj", folder.path("meshes/file_out.obj"));
    fs::create_symlink("../secret/not_there.obj", folder.path("meshes/nothing_out.obj"));
    fs::create_symlink("deep/cup.obj", folder.path("meshes/file_in.obj"));
    fs::create_directory_symlink("meshes", folder.path("linked_meshes"));
    locator = [this](const std::string& package) {
      asked.push_back(package);
      const std::string path = folder.path("packages/" + package);
      return fs::exists(path) ? path : std::string();
    };
    roots = parseMeshRoots({"package://arm", folder.path("meshes")}, "~mesh_roots");
  }

  std::string refusalOf(const std::string& resource) {
    try {
      return "found " + locateMeshBelow(resource, roots, locator).path;
    } catch (const Error& error) {
      return error.what();
    }
  }

  std::string uniform(const std::string& resource) { return outsideOfMeshFolders(resource).what(); }

  /// The same by way of add_body's loadBody(), whatever of it says no.
  std::string bodyRefusalOf(const std::string& resource) {
    BodyDescription description;
    description.name = "x";
    description.frame = "world";
    description.mesh_resource = resource;
    description.mesh_access.roots = roots;
    try {
      static_cast<void>(loadBody(description, "", locator));
    } catch (const Error& error) {
      return error.what();
    }
    return "added";
  }

  test::TemporaryFolder folder;
  PackageLocator locator;
  std::vector<std::string> asked;
  MeshRoots roots;
};

TEST_F(MeshRootsTest, FilesBelowThemAreFound) {
  for (const std::string resource :
       {"package://arm/meshes/link.obj", "package://arm/meshes/../meshes/link.obj"}) {
    EXPECT_EQ(bodyRefusalOf(resource), "added") << resource;
  }
  for (const std::string name :
       {"meshes/deep/cup.obj", "meshes/deep/../deep/cup.obj", "meshes/file_in.obj"}) {
    EXPECT_EQ(bodyRefusalOf(folder.path(name)), "added") << name;
    EXPECT_EQ(bodyRefusalOf("file://" + folder.path(name)), "added") << name;
  }
}

TEST_F(MeshRootsTest, ARootMayBeALinkItself) {
  roots = parseMeshRoots({folder.path("linked_meshes") + "/"}, "~mesh_roots");
  EXPECT_EQ(bodyRefusalOf(folder.path("linked_meshes/deep/cup.obj")), "added");
  EXPECT_EQ(bodyRefusalOf(folder.path("meshes/deep/cup.obj")), "added");
  EXPECT_EQ(refusalOf(folder.path("linked_meshes/file_out.obj")),
            uniform(folder.path("linked_meshes/file_out.obj")));
}

TEST_F(MeshRootsTest, OutsideOfThemThereIsOneRefusalWhateverIsThere) {
  for (const std::string name : {"secret/there.obj",
                                 "secret/not_there.obj",
                                 "secret/folder.obj",
                                 "secret/fifo.obj",
                                 "secret",
                                 "secret/there.obj/below",
                                 "meshes/link_out/there.obj",
                                 "meshes/link_out/not_there.obj",
                                 "meshes/link_out/folder.obj",
                                 "meshes/link_out/fifo.obj",
                                 "meshes/link_out/no/such/folder.obj",
                                 "meshes/file_out.obj",
                                 "meshes/nothing_out.obj",
                                 "meshes/nothing_out.obj/below",
                                 "meshes/../secret/there.obj",
                                 "meshes/../secret/not_there.obj",
                                 "meshes/deep/../../secret/there.obj",
                                 "meshes/%2e%2e/secret/there.obj",
                                 "meshes/no_folder/../../secret/not_there.obj",
                                 "meshesX/there.obj",
                                 "packages/arm/meshes/link.obj"}) {
    for (const std::string& resource : {folder.path(name), "file://" + folder.path(name)}) {
      EXPECT_EQ(refusalOf(resource), uniform(resource));
      EXPECT_EQ(bodyRefusalOf(resource), "body 'x': body 'x', " + uniform(resource) + " (it is not added)");
    }
  }
  for (const std::string resource :
       {"/etc/passwd", "/etc/no_such_file", "/root/.ssh/id_rsa", "/dev/zero", "/proc/self/mem",
        "/proc/1/root/etc", "package://arm/../other/meshes/link.obj",
        "package://arm/../other/meshes/none.obj", "package://arm/../../secret/there.obj",
        "package://arm/../../secret/not_there.obj", "package://arm/%2e%2e/%2e%2e/secret/there.obj",
        "package://arm/../../../../../../../../etc/passwd"}) {
    EXPECT_EQ(refusalOf(resource), uniform(resource));
  }
}

TEST_F(MeshRootsTest, APackageThatIsNotListedIsNotEvenLookedFor) {
  for (const std::string resource : {"package://other/meshes/link.obj", "package://none/meshes/link.obj",
                                     "package://other", "package:///x"}) {
    EXPECT_EQ(refusalOf(resource), uniform(resource));
  }
  EXPECT_TRUE(asked.empty());
}

TEST_F(MeshRootsTest, BelowThemTheRefusalSaysWhatIsWrong) {
  EXPECT_NE(refusalOf(folder.path("meshes/none.obj")).find("does not exist"), std::string::npos);
  EXPECT_NE(refusalOf(folder.path("meshes/deep")).find("is a folder"), std::string::npos);
  EXPECT_NE(refusalOf("package://arm/meshes/none.obj").find("does not exist"), std::string::npos);
  roots.every_package = true;
  EXPECT_NE(refusalOf("package://none/meshes/link.obj").find("is not known"), std::string::npos);
  asked.clear();
  for (const std::string resource :
       {"package://--help/x", "package://a b/x", "package://a;b/x", "package://$(x)/x"}) {
    EXPECT_NE(refusalOf(resource).find("is not known"), std::string::npos) << resource;
  }
  EXPECT_TRUE(asked.empty()) << asked.front();
}

TEST_F(MeshRootsTest, OddNamesAreRefusedWithoutALook) {
  EXPECT_NE(refusalOf(folder.path("meshes/deep/cup.obj%00/../../../secret")).find("zero byte"),
            std::string::npos);
  EXPECT_NE(refusalOf(std::string("/a\0b", 4)).find("zero byte"), std::string::npos);
  const std::string long_name = refusalOf("/" + std::string(100'000, 'a'));
  EXPECT_NE(long_name.find("100001 characters"), std::string::npos);
  EXPECT_LT(long_name.size(), 300U);
  EXPECT_NE(refusalOf("meshes/deep/cup.obj").find("relative path"), std::string::npos);
}

TEST_F(MeshRootsTest, NoRootsMeanNoFile) {
  roots = parseMeshRoots({}, "~mesh_roots");
  EXPECT_EQ(refusalOf("package://arm/meshes/link.obj"), uniform("package://arm/meshes/link.obj"));
  EXPECT_EQ(refusalOf(folder.path("meshes/deep/cup.obj")), uniform(folder.path("meshes/deep/cup.obj")));
}

TEST(MeshRoots, EntriesArePackagesOrAbsoluteFolders) {
  const MeshRoots roots = parseMeshRoots({"package://", "package://arm", "/data/", "/"}, "~mesh_roots");
  EXPECT_TRUE(roots.every_package);
  EXPECT_EQ(roots.packages, std::vector<std::string>{"arm"});
  EXPECT_EQ(roots.folders, (std::vector<std::string>{"/data", "/"}));
  for (const std::string bad : {"", "meshes", "~/meshes", "http://x"}) {
    EXPECT_THROW(parseMeshRoots({bad}, "~mesh_roots"), Error) << bad;
  }
}

TEST(MeshImport, LimitsReachTheFilesOfAScene) {
  const test::TemporaryFolder folder;
  folder.write("part.obj", kTriangle);
  SceneLoadOptions options;
  const std::string yaml = "bodies: [{name: part, frame: world, mesh: part.obj}]";
  EXPECT_EQ(loadSceneText(yaml, "scene", folder.path(), options).bodies.size(), 1U);
  options.mesh_import.memory = 10;
  const Scene scene = loadSceneText(yaml, "scene", folder.path(), options);
  EXPECT_EQ(scene.bodies.size(), 0U);
  ASSERT_EQ(scene.problems.size(), 1U);
  EXPECT_NE(scene.problems[0].message.find("~limits/import_memory_mb"), std::string::npos);
}

}  // namespace
}  // namespace concave_distance::mesh_roots_test
