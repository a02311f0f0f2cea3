#include "loading/query_poses.h"

#include <gtest/gtest.h>

#include <cmath>

#include "concave_distance/base/error.h"
#include "support/temporary_folder.h"

namespace concave_distance::query_poses_test {
namespace {

using test::TemporaryFolder;

constexpr const char* kHeader = "t,x,y,z,qx,qy,qz,qw\n";

/// What reading the text complains about; empty when it does not.
std::string complaintAbout(const std::string& text) {
  const TemporaryFolder folder;
  const std::string path = folder.write("poses.csv", text);
  try {
    readQueryPoses(path);
  } catch (const Error& error) {
    return std::string(error.what()).substr(folder.path().size() + 1);
  }
  return "";
}

TEST(ReadQueryPoses, ReadsEveryColumn) {
  const TemporaryFolder folder;
  const std::string path = folder.write(
      "poses.csv", std::string(kHeader) + "0.5,1,-2,3e-3,0.1,0.2,0.3,0.9\n 1 ,+4,5,.5, 0,0,0,1 \n");
  const std::vector<QueryPose> poses = readQueryPoses(path);
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(poses[0].time, 0.5);
  EXPECT_EQ(poses[0].position, Eigen::Vector3d(1, -2, 3e-3));
  EXPECT_EQ(poses[0].quaternion, Eigen::Vector4d(0.1, 0.2, 0.3, 0.9));
  EXPECT_EQ(poses[1].position, Eigen::Vector3d(4, 5, 0.5));
}

TEST(ReadQueryPoses, TakesFilesAsWindowsAndSpreadsheetsWriteThem) {
  const TemporaryFolder folder;
  const std::string path =
      folder.write("poses.csv", "\xEF\xBB\xBFt,x,y,z,qx,qy,qz,qw\r\n0,1,2,3,0,0,0,1\r\n\r\n1,1,2,3,0,0,0,1");
  EXPECT_EQ(readQueryPoses(path).size(), 2U);
}

TEST(ReadQueryPoses, KeepsSeventeenDigits) {
  const TemporaryFolder folder;
  const std::string path = folder.write(
      "poses.csv", std::string(kHeader) + "0,0.10000000000000001,-1.2345678901234567e-5,0,0,0,0,1\n");
  const QueryPose pose = readQueryPoses(path).front();
  EXPECT_EQ(pose.position.x(), 0.1);
  EXPECT_EQ(pose.position.y(), -1.2345678901234567e-5);
}

TEST(ReadQueryPoses, NamesFileLineAndColumnOfWhatIsWrong) {
  const std::string good = "0,0,0,0,0,0,0,1\n";
  EXPECT_EQ(complaintAbout(kHeader + good), "");
  EXPECT_EQ(complaintAbout(kHeader), "");  // no query: nothing to answer, nothing wrong
  EXPECT_EQ(complaintAbout(kHeader + good + "0,0,zero,0,0,0,0,1\n"),
            "poses.csv:3: column y is 'zero' (write a number with a point, such as -0.25 or 1e-3)");
  EXPECT_EQ(complaintAbout(kHeader + good + "\n0,0,0,0,0,0,1\n"),
            "poses.csv:4: it has 7 cells (write 8: t,x,y,z,qx,qy,qz,qw)");
  EXPECT_EQ(complaintAbout(kHeader + std::string("0,0,0,0,0,0,0,1,2\n")),
            "poses.csv:2: it has 9 cells (write 8: t,x,y,z,qx,qy,qz,qw)");
  EXPECT_EQ(complaintAbout(kHeader + std::string("0,0,0,,0,0,0,1\n")),
            "poses.csv:2: column z is '' (write a number with a point, such as -0.25 or 1e-3)");
  EXPECT_EQ(complaintAbout(kHeader + std::string("0,0,0,1 2,0,0,0,1\n")),
            "poses.csv:2: column z is '1 2' (write a number with a point, such as -0.25 or 1e-3)");
  EXPECT_EQ(complaintAbout(kHeader + std::string("nan,0,0,0,0,0,0,1\n")),
            "poses.csv:2: column t is 'nan' (give each line a time in seconds)");
  EXPECT_EQ(complaintAbout("x,y,z,qx,qy,qz,qw\n" + good),
            "poses.csv:1: the header is 'x,y,z,qx,qy,qz,qw' (the first line has to be t,x,y,z,qx,qy,qz,qw)");
  EXPECT_EQ(
      complaintAbout("t,x,y,z,qw,qx,qy,qz\n" + good),
      "poses.csv:1: the header is 't,x,y,z,qw,qx,qy,qz' (the first line has to be t,x,y,z,qx,qy,qz,qw)");
  EXPECT_EQ(complaintAbout(""),
            "poses.csv: the file is empty (the first line has to be t,x,y,z,qx,qy,qz,qw)");
  EXPECT_THROW(readQueryPoses("/nowhere/poses.csv"), Error);
}

TEST(PoseOf, NormalisesQuaternionsThatAreNearlyUnit) {
  QueryPose query;
  query.position = Eigen::Vector3d(1, 2, 3);
  query.quaternion = 1.0009 * Eigen::Vector4d(0, 0, std::sin(0.25), std::cos(0.25));
  const auto pose = poseOf(query);
  ASSERT_TRUE(pose);
  const Eigen::Matrix3d expected = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  EXPECT_LT((pose->linear() - expected).norm(), 1e-15);
  EXPECT_EQ(pose->translation(), query.position);
}

TEST(PoseOf, RefusesOtherQuaternionsAndNumbersThatAreNotFinite) {
  QueryPose query;
  EXPECT_FALSE(poseOf(query));
  query.quaternion = Eigen::Vector4d(0, 0, 0, 1.0011);
  EXPECT_FALSE(poseOf(query));
  query.quaternion = Eigen::Vector4d(0, 0, 0, 0.9989);
  EXPECT_FALSE(poseOf(query));
  query.quaternion = Eigen::Vector4d(0, 0, 0, 1);
  EXPECT_TRUE(poseOf(query));
  query.position.y() = std::nan("");
  EXPECT_FALSE(poseOf(query));
  query.position.y() = INFINITY;
  EXPECT_FALSE(poseOf(query));
  query.position.y() = 0.0;
  query.quaternion.x() = std::nan("");
  EXPECT_FALSE(poseOf(query));
}

}  // namespace
}  // namespace concave_distance::query_poses_test
