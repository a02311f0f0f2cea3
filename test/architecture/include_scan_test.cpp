#include <gtest/gtest.h>

#include "architecture/include_scan.h"

namespace concave_distance {
namespace {

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

TEST(Architecture, NoIncludeOfAnyRoomPointsUpwards) {
  std::size_t files_seen = 0;
  const std::vector<std::string> faults = faultsOfRooms(CONCAVE_DISTANCE_SOURCE_DIR, files_seen);
  EXPECT_TRUE(faults.empty()) << joined(faults);
  EXPECT_GT(files_seen, 30u) << "the scan did not find the package's files";
}

TEST(IncludeScan, AcceptsTheSameRoomALowerOneAndLibraries) {
  const std::string text =
      "#include \"concave_distance/search/a.h\"\n#include \"concave_distance/mesh/b.h\"\n#include <vector>\n";
  EXPECT_TRUE(faultsOfIncludes(text, "search", "concave_distance/search/a.h").empty());
}

TEST(IncludeScan, ReportsAnArrowUpwards) {
  const auto faults = faultsOfIncludes("  #  include <concave_distance/search/a.h>\n", "mesh", "");
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_NE(faults.front().find("upwards"), std::string::npos);
}

TEST(IncludeScan, ReportsARoomThatIsNotListed) {
  EXPECT_EQ(faultsOfIncludes("#include \"concave_distance/attic/a.h\"\n", "mesh", "").size(), 1u);
  EXPECT_EQ(faultsOfIncludes("", "attic", "").size(), 1u);
}

TEST(IncludeScan, ReportsRosHeadersBelowTheTopRoomOnly) {
  for (const std::string header : {"ros/ros.h", "tf2_ros/buffer.h", "geometry_msgs/Pose.h",
                                   "std_srvs/Empty.h", "concave_distance/Niche.h"}) {
    const std::string text = "#include <" + header + ">\n";
    EXPECT_EQ(faultsOfIncludes(text, "scene", "").size(), 1u) << header;
    EXPECT_TRUE(faultsOfIncludes(text, "ros", "").empty()) << header;
  }
  EXPECT_TRUE(faultsOfIncludes("#include <urdf_parser/urdf_parser.h>\n", "scene", "").empty());
}

TEST(IncludeScan, ReportsASourceFileWhoseOwnHeaderIsNotFirst) {
  const std::string text = "#include <vector>\n#include \"concave_distance/mesh/a.h\"\n";
  EXPECT_EQ(faultsOfIncludes(text, "mesh", "concave_distance/mesh/a.h").size(), 1u);
}

}  // namespace
}  // namespace concave_distance
