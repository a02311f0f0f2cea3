#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "architecture/include_scan.h"

namespace concave_distance::include_scan_test {
namespace {

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

TEST(Architecture, NoIncludePointsUpwards) {
  std::size_t files_seen = 0;
  const std::vector<std::string> faults = faultsOfFolders(CONCAVE_DISTANCE_SOURCE_DIR, files_seen);
  EXPECT_TRUE(faults.empty()) << joined(faults);
  EXPECT_GT(files_seen, 30u) << "the scan did not find the package's files";
}

TEST(Architecture, NoTestOfTheCoreIncludesTheThesis) {
  namespace fs = std::filesystem;
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(CONCAVE_DISTANCE_SOURCE_DIR) / "test")) {
    if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);) {
      EXPECT_NE(line.rfind("#include \"thesis/", 0), 0U) << entry.path();
    }
    ++files;
  }
  EXPECT_GT(files, 100U);
}

TEST(Architecture, FewHeadersArePublic) {
  namespace fs = std::filesystem;
  std::size_t headers = 0;
  for (const auto& entry :
       fs::recursive_directory_iterator(fs::path(CONCAVE_DISTANCE_SOURCE_DIR) / "include")) {
    headers += entry.path().extension() == ".h" ? 1 : 0;
  }
  EXPECT_GT(headers, 30U);
  EXPECT_LE(headers, 64U) << "each is a promise to keep";
}

TEST(IncludeScan, AcceptsTheSameFolderALowerOneAndLibraries) {
  const std::string text =
      "#include \"concave_distance/search/a.h\"\n#include \"mesh/trees/b.h\"\n#include <vector>\n";
  EXPECT_TRUE(faultsOfIncludes(text, "search/x.cpp", "concave_distance/search/a.h").empty());
}

TEST(IncludeScan, ReportsAnArrowUpwards) {
  const auto faults = faultsOfIncludes("  #  include <concave_distance/search/a.h>\n", "mesh/x.cpp", "");
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_NE(faults.front().find("upwards"), std::string::npos);
}

TEST(IncludeScan, ReportsAFolderThatIsNotListed) {
  EXPECT_EQ(faultsOfIncludes("#include \"concave_distance/attic/a.h\"\n", "mesh/x.cpp", "").size(), 1u);
  EXPECT_EQ(faultsOfIncludes("", "attic/x.cpp", "").size(), 1u);
}

TEST(IncludeScan, ReportsRosHeadersBelowTheTopFolderOnly) {
  for (const std::string header : {"ros/ros.h", "tf2_ros/buffer.h", "geometry_msgs/Pose.h",
                                   "std_srvs/Empty.h", "concave_distance/Niche.h"}) {
    const std::string text = "#include <" + header + ">\n";
    EXPECT_EQ(faultsOfIncludes(text, "scene/x.cpp", "").size(), 1u) << header;
    EXPECT_TRUE(faultsOfIncludes(text, "ros/x.cpp", "").empty()) << header;
  }
  EXPECT_TRUE(faultsOfIncludes("#include <urdf_parser/urdf_parser.h>\n", "scene/x.cpp", "").empty());
}

TEST(IncludeScan, ReportsAnArrowUpwardsBetweenFoldersOfTheNode) {
  const std::string text = "#include \"ros/markers/a.h\"\n#include \"ros/time_difference.h\"\n";
  EXPECT_TRUE(faultsOfIncludes(text, "ros/node/x.cpp", "").empty());
  EXPECT_EQ(faultsOfIncludes(text, "ros/tf/x.cpp", "").size(), 1u);
}

TEST(IncludeScan, ReportsWhatReachesTheThesis) {
  const std::string text = "#include \"thesis/src/annealing/a.h\"\n";
  for (const char* file : {"search/x.cpp", "tools/mesh_tool.cpp", "ros/x.cpp"}) {
    EXPECT_FALSE(faultsOfIncludes(text, file, "").empty()) << file;
  }
  for (const char* file : {"thesis/src/evaluation/x.cpp", "thesis/src/annealing/x.h"}) {
    EXPECT_TRUE(faultsOfIncludes(text, file, "").empty()) << file;
  }
  EXPECT_FALSE(faultsOfIncludes(text, "thesis/src/continuous/x.cpp", "").empty()) << "an arrow upwards";
}

TEST(IncludeScan, ReportsWhatReachesTheSearchGrid) {
  const std::string text = "#include \"search/grid/a.h\"\n";
  for (const char* file : {"mesh/x.cpp", "distance/niches/x.h", "loading/x.cpp", "scene/x.cpp", "tools/x.cpp",
                           "ros/messages/x.cpp"}) {
    EXPECT_FALSE(faultsOfIncludes(text, file, "").empty()) << file;
  }
  for (const char* file : {"search/grid/x.cpp", "search/x.h", "tracking/x.cpp", "thesis/src/annealing/x.h"}) {
    EXPECT_TRUE(faultsOfIncludes(text, file, "").empty()) << file;
  }
}

TEST(IncludeScan, ReportsASourceFileWhoseOwnHeaderIsNotFirst) {
  const std::string text = "#include <vector>\n#include \"concave_distance/mesh/a.h\"\n";
  EXPECT_EQ(faultsOfIncludes(text, "mesh/x.cpp", "concave_distance/mesh/a.h").size(), 1u);
}

}  // namespace
}  // namespace concave_distance::include_scan_test
