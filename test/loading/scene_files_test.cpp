// Where save_scene may write, and what it replaces.
#include "loading/scene_files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "concave_distance/base/error.h"
#include "support/scene_fixture.h"
#include "support/temporary_folder.h"

namespace concave_distance::scene_files_test {
namespace {

using namespace detail;

class SceneFilesTest : public ::testing::Test {
 protected:
  std::string refused(const std::string& path, bool overwrite = false) const {
    try {
      writeScene(path, {{"x.yaml", kSavedSceneMark}, {"x_1.obj", "v 0 0 0\n"}}, overwrite);
      return "accepted";
    } catch (const Error& error) {
      return error.what();
    }
  }
  std::string refusedPath(const std::string& root, const std::string& path) const {
    try {
      return pathBelow(root, path);
    } catch (const Error& error) {
      return error.what();
    }
  }
  std::size_t filesIn(const std::string& path) const {
    const auto files = std::filesystem::directory_iterator(path);
    return static_cast<std::size_t>(std::distance(begin(files), end(files)));
  }

  test::TemporaryFolder folder;
};

TEST_F(SceneFilesTest, ReplaceOnlyWhatSaveSceneWroteAndOnlyWhenTold) {
  const std::string path = folder.path() + "/x.yaml";
  EXPECT_EQ(refused(path), "accepted");
  EXPECT_TRUE(test::mentions(refused(path), "the file is there already (name another file, or set overwrite"))
      << refused(path);
  EXPECT_EQ(refused(path, true), "accepted");
  folder.write("mine.yaml", "bodies: []\n");
  const std::string message = refused(folder.path() + "/mine.yaml", true);
  EXPECT_TRUE(test::mentions(message, "no scene that save_scene has written")) << message;
  std::ifstream mine(folder.path() + "/mine.yaml");
  std::string line;
  std::getline(mine, line);
  EXPECT_EQ(line, "bodies: []");
}

TEST_F(SceneFilesTest, LeaveNothingWhenOneCannotBeWritten) {
  const std::string inside = folder.path() + "/inside";
  std::filesystem::create_directories(inside + "/x_1.obj/held");  // a folder where the mesh should be
  const std::size_t before = filesIn(inside);
  EXPECT_NE(refused(inside + "/x.yaml"), "accepted");
  EXPECT_EQ(filesIn(inside), before);
  EXPECT_TRUE(
      test::mentions(refused(folder.path() + "/nowhere/x.yaml"), "cannot be written (check that its folder"));
}

TEST_F(SceneFilesTest, LieBelowTheFolderThatWasChosen) {
  const std::string root = folder.path();
  std::filesystem::create_directories(root + "/scenes/deep");
  std::filesystem::create_directory_symlink("/tmp", root + "/scenes/out");
  const std::string scenes = root + "/scenes";
  EXPECT_EQ(refusedPath(scenes, "deep/x.yaml"), std::filesystem::canonical(scenes).string() + "/deep/x.yaml");
  EXPECT_EQ(refusedPath(scenes, scenes + "/x.yaml"), std::filesystem::canonical(scenes).string() + "/x.yaml");
  EXPECT_TRUE(test::mentions(refusedPath(scenes, "../x.yaml"), "is not below"));
  EXPECT_TRUE(test::mentions(refusedPath(scenes, "/etc/x.yaml"), "is not below"));
  EXPECT_TRUE(test::mentions(refusedPath(scenes, "out/x.yaml"), "is not below")) << "through a link";
  EXPECT_TRUE(test::mentions(refusedPath(scenes, "x.txt"), "name a file that ends in .yaml"));
  EXPECT_TRUE(test::mentions(refusedPath(scenes, ""), "name a file that ends in .yaml"));
  EXPECT_TRUE(test::mentions(refusedPath(scenes, "none/x.yaml"), "there is no folder"));
  EXPECT_TRUE(test::mentions(refusedPath("", "x.yaml"), "set ~save_folder"));
  EXPECT_TRUE(test::mentions(refusedPath(root + "/none", "x.yaml"), "~save_folder: there is no folder"));
}

}  // namespace
}  // namespace concave_distance::scene_files_test
