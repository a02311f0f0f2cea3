#include "mesh/import/mesh_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "support/temporary_folder.h"

namespace concave_distance::mesh_file_test {
namespace {

using test::TemporaryFolder;

std::string refusalOf(const std::string& path, const std::vector<std::string>& folders = {}) {
  try {
    const MeshFile file(path, folders);
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), path);
    return error.whatIsWrong();
  }
  return {};
}

TEST(MeshFile, OpensARegularFileAndKnowsItsSizeAndEnding) {
  const TemporaryFolder folder;
  const MeshFile file(folder.write("part.v2.STL", "12345"));
  EXPECT_EQ(file.size(), 5U);
  EXPECT_EQ(file.extension(), ".stl");
  char byte = 0;
  EXPECT_EQ(read(file.descriptor(), &byte, 1), 1);
  EXPECT_EQ(byte, '1');
}

TEST(MeshFile, TouchesNeitherFifosNorDevicesNorFolders) {
  const TemporaryFolder folder;
  const std::string fifo = folder.path("fifo.stl");
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  for (const std::string& path : {fifo, folder.path(), std::string("/dev/zero"), std::string("/dev/tty")}) {
    EXPECT_NE(refusalOf(path).find("not a file"), std::string::npos) << path << ": " << refusalOf(path);
  }
  // Had it been opened, this would find a reader.
  EXPECT_LT(open(fifo.c_str(), O_WRONLY | O_NONBLOCK), 0);
}

TEST(MeshFile, RefusesWhatIsMissingOrEmpty) {
  const TemporaryFolder folder;
  EXPECT_NE(refusalOf(folder.path("missing.stl")).find("no such file"), std::string::npos);
  EXPECT_NE(refusalOf(folder.write("empty.stl", "")).find("empty"), std::string::npos);
  std::filesystem::create_symlink("loop.stl", folder.path("loop.stl"));
  EXPECT_NE(refusalOf(folder.path("loop.stl")).find("cannot be opened"), std::string::npos);
}

TEST(MeshFile, StaysTheFileThatWasOpened) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.stl", "old");
  const MeshFile file(path);
  std::filesystem::rename(folder.write("b.stl", "newer"), path);
  char bytes[8] = {};
  EXPECT_EQ(read(file.descriptor(), bytes, sizeof bytes), 3);
}

TEST(MeshFile, MustLieBelowAFolderAlsoBehindLinks) {
  const TemporaryFolder folder;
  const std::string allowed = folder.path("meshes");
  std::filesystem::create_directories(allowed + "/deep");
  std::filesystem::create_directories(folder.path("meshes_of_others"));
  const std::string inside = folder.write("meshes/deep/a.stl", "x");
  const std::string outside = folder.write("secret.stl", "x");
  const std::string beside = folder.write("meshes_of_others/a.stl", "x");
  std::filesystem::create_symlink("../secret.stl", allowed + "/out.stl");
  std::filesystem::create_symlink("deep/a.stl", allowed + "/in.stl");
  const std::string real = std::filesystem::canonical(allowed).string();
  EXPECT_EQ(refusalOf(inside, {real}), "");
  EXPECT_EQ(refusalOf(allowed + "/in.stl", {real}), "");
  EXPECT_EQ(refusalOf(outside, {"/nowhere", std::filesystem::canonical(folder.path()).string()}), "");
  for (const std::string& path : {outside, beside, allowed + "/out.stl", allowed + "/../secret.stl",
                                  std::string("/dev/zero"), std::string("/proc/self/mem")}) {
    EXPECT_EQ(refusalOf(path, {real}), outsideOfMeshFolders("").whatIsWrong()) << path;
  }
}

TEST(MeshFile, IsBelowComparesWholeNames) {
  EXPECT_TRUE(isBelow("/a/b", "/a"));
  EXPECT_TRUE(isBelow("/a", "/a"));
  EXPECT_TRUE(isBelow("/a", "/"));
  EXPECT_FALSE(isBelow("/ab", "/a"));
  EXPECT_FALSE(isBelow("/", "/a"));
}

}  // namespace
}  // namespace concave_distance::mesh_file_test
