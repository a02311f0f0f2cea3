#include "base/output_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "concave_distance/base/error.h"
#include "support/temporary_folder.h"

namespace concave_distance::output_file_test {
namespace {

namespace fs = std::filesystem;

class OutputFileTest : public testing::Test {
 protected:
  std::size_t fileCount() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()));
  }
  test::TemporaryFolder folder;
};

TEST_F(OutputFileTest, IsThereWhenItIsComplete) {
  const std::string path = folder.write("out.csv", "before");
  OutputFile file(path);
  file.stream() << 0.1 << '\n';
  EXPECT_EQ(test::contentOf(path), "before");
  file.finish();
  EXPECT_EQ(test::contentOf(path), "0.10000000000000001\n");
  EXPECT_EQ(fileCount(), 1U);
}

TEST_F(OutputFileTest, LeavesNothingBehindWhenItIsGivenUp) {
  {
    OutputFile file(folder.path("out.csv"));
    file.stream() << "half of it";
  }
  EXPECT_EQ(fileCount(), 0U);
}

TEST_F(OutputFileTest, KeepsLinksAndRights) {
  const std::string target = folder.write("target.csv", "before");
  fs::permissions(target, fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("target.csv", folder.path("link.csv"));
  for (const char* name : {"link.csv", "target.csv"}) {
    OutputFile file(folder.path(name));
    file.stream() << "after " << name;
    file.finish();
    EXPECT_TRUE(fs::is_symlink(folder.path("link.csv")));
    EXPECT_EQ(test::contentOf(target), std::string("after ") + name);
    EXPECT_EQ(fs::status(target).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  }
}

TEST_F(OutputFileTest, SaysThatADeviceIsFull) {
  fs::create_symlink("/dev/full", folder.path("full.csv"));
  for (const std::string& path : {std::string("/dev/full"), folder.path("full.csv")}) {
    OutputFile file(path);
    file.stream() << "something";
    try {
      file.finish();
      FAIL() << path;
    } catch (const Error& error) {
      EXPECT_EQ(error.where(), path);
    }
  }
  EXPECT_EQ(fileCount(), 1U);
}

TEST_F(OutputFileTest, SaysWhereItCannotWrite) {
  EXPECT_THROW(OutputFile("/nowhere/out.csv"), Error);
  EXPECT_THROW(OutputFile(folder.path()), Error) << "a folder";
  EXPECT_THROW(OutputFile(""), Error);
}

TEST_F(OutputFileTest, RefusesAFileThatIsAnInputOrAnotherOutput) {
  folder.write("in.csv", "");
  fs::create_symlink("in.csv", folder.path("link.csv"));
  fs::create_hard_link(folder.path("in.csv"), folder.path("hard.csv"));
  fs::create_directories(folder.path("sub"));
  const auto clash = [&](const std::string& left, const std::string& right) {
    try {
      requireDistinctFiles({{"--poses", folder.path(left)}}, {{"--output", folder.path(right)}});
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("--poses"), std::string::npos) << error.what();
      return true;
    }
    return false;
  };
  for (const char* output : {"in.csv", "link.csv", "hard.csv", "./in.csv", "sub/../in.csv"}) {
    EXPECT_TRUE(clash("in.csv", output)) << output;
    EXPECT_TRUE(clash(output, "in.csv")) << output;
  }
  EXPECT_TRUE(clash("new.csv", "sub/../new.csv")) << "not there yet";
  EXPECT_FALSE(clash("in.csv", "other.csv"));
  EXPECT_THROW(requireDistinctFiles({}, {{"--a", folder.path("x")}, {"--b", folder.path("x")}}), Error);
  EXPECT_NO_THROW(requireDistinctFiles({}, {{"--a", "/dev/null"}, {"--b", "/dev/null"}}));
  EXPECT_NO_THROW(requireDistinctFiles({}, {{"--a", ""}, {"--b", ""}}));
}

}  // namespace
}  // namespace concave_distance::output_file_test
