#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "benchmark/support/joint_path.h"
#include "concave_distance/base/error.h"
#include "loading/query_poses.h"
#include "simulation/pose_path.h"
#include "support/temporary_folder.h"

namespace concave_distance::demo::demo_paths_test {
namespace {

using benchmark::JointPath;
using benchmark::NamedJointPath;
using benchmark::readJointPath;

class FileTest : public ::testing::Test {
 protected:
  std::string errorOf(const std::string& text, bool joints) {
    try {
      if (joints) {
        readJointPath(folder_.write("table.csv", text));
      } else {
        readPosePath(folder_.write("table.csv", text));
      }
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  test::TemporaryFolder folder_;
};

JointPath makeWave(double period, int count) {
  std::vector<double> times;
  Eigen::MatrixXd waypoints(count, 2);
  for (int i = 0; i < count; ++i) {
    const double time = period * i / count;
    times.push_back(time);
    waypoints.row(i) << std::sin(2.0 * M_PI * time / period), std::cos(2.0 * M_PI * time / period);
  }
  return {times, waypoints, period};
}

TEST(JointPath, PassesThroughItsWaypointsAndRepeats) {
  const JointPath path = makeWave(4.0, 8);
  for (int i = 0; i < 8; ++i) {
    const double time = 0.5 * i;
    EXPECT_NEAR(path.at(time)[0], std::sin(M_PI * time / 2.0), 1e-14);
    EXPECT_TRUE(path.at(time + 4.0).isApprox(path.at(time), 1e-12));
    EXPECT_TRUE(path.at(time - 4.0).isApprox(path.at(time), 1e-12));
  }
}

TEST(JointPath, FollowsASmoothCurveToFourthOrder) {
  // The error of a cubic spline: 5/384 h^4 max|f''''| (Hall and Meyer 1976).
  const double h = 4.0 / 32;
  const double bound = 5.0 / 384.0 * std::pow(h * M_PI / 2.0, 4);
  const JointPath path = makeWave(4.0, 32);
  for (int i = 0; i < 1000; ++i) {
    const double time = 0.004 * i;
    EXPECT_NEAR(path.at(time)[0], std::sin(M_PI * time / 2.0), bound);
    EXPECT_NEAR(path.at(time)[1], std::cos(M_PI * time / 2.0), bound);
  }
}

TEST(PosePath, IsStraightAndTurnsSteadilyBetweenPoses) {
  Eigen::Isometry3d first = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d second = Eigen::Isometry3d::Identity();
  second.translation() = Eigen::Vector3d(2, 0, 0);
  second.linear() = Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const PosePath path({{1.0, first}, {3.0, second}});
  const Eigen::Isometry3d quarter = path.poseAt(1.5);
  EXPECT_NEAR(quarter.translation().x(), 0.5, 1e-15);
  EXPECT_NEAR(Eigen::AngleAxisd(quarter.linear()).angle(), 0.25, 1e-14);
  EXPECT_TRUE(path.poseAt(0.0).isApprox(first));
  EXPECT_TRUE(path.poseAt(9.0).isApprox(second));
}

TEST_F(FileTest, PoseFilesAreRefusedWithFileAndReason) {
  const std::string header = "t,x,y,z,qx,qy,qz,qw\n";
  EXPECT_NE(errorOf("t,x,y,z\n0,0,0,0\n", false).find("header"), std::string::npos);
  EXPECT_NE(errorOf(header + "0,0,0,0,0,0,0,2\n", false).find("is not a pose"), std::string::npos);
  EXPECT_NE(errorOf(header + "0,0,0,0,0,0,0,one\n", false).find("table.csv:2"), std::string::npos);
  EXPECT_NE(errorOf(header + "0,0,0,0,0,0,1\n", false).find("7 cells"), std::string::npos);
  EXPECT_NE(errorOf(header + "1,0,0,0,0,0,0,1\n1,0,0,0,0,0,0,1\n", false).find("not after the one before"),
            std::string::npos);
  EXPECT_NE(errorOf(header, false).find("holds no pose"), std::string::npos);
}

TEST_F(FileTest, JointFilesMustCloseAndBeginAtZero) {
  EXPECT_EQ(errorOf("t,a\n0,1\n1,2\n2,3\n3,1\n", true), "");
  EXPECT_NE(errorOf("t,a\n0,1\n1,2\n2,3\n3,1.5\n", true).find("does not close"), std::string::npos);
  EXPECT_NE(errorOf("t,a\n1,1\n2,2\n3,3\n4,1\n", true).find("the first at t = 0"), std::string::npos);
  EXPECT_NE(errorOf("t,a\n0,1\n1,1\n", true).find("at least four"), std::string::npos);
}

TEST(WamPath, StaysWithinTheLimitsOfTheUrdfInPositionAndSpeed) {
  const NamedJointPath wam = readJointPath(std::string(CONCAVE_DISTANCE_SOURCE_DIR) + "/config/wam_path.csv");
  ASSERT_EQ(wam.joints, (std::vector<std::string>{"j1", "j2", "j3", "j4", "j5", "j6", "j7"}));
  // urdf/wam.urdf
  const double lower[] = {-2.6, -2.0, -2.8, -0.9, -4.76, -1.6, -3.0};
  const double upper[] = {2.6, 2.0, 2.8, 3.1, 1.24, 1.6, 3.0};
  const double fastest[] = {0.75, 0.75, 2.0, 2.0, 2.5, 2.5, 2.5};
  constexpr double kStep = 0.001;
  Eigen::VectorXd last = wam.path.at(-kStep);
  for (double time = 0.0; time < wam.path.period(); time += kStep) {
    const Eigen::VectorXd now = wam.path.at(time);
    for (int joint = 0; joint < 7; ++joint) {
      ASSERT_GE(now[joint], lower[joint]) << "joint " << joint << " at " << time;
      ASSERT_LE(now[joint], upper[joint]) << "joint " << joint << " at " << time;
      ASSERT_LE(std::abs(now[joint] - last[joint]), fastest[joint] * kStep)
          << "joint " << joint << " at " << time;
    }
    last = now;
  }
}

}  // namespace
}  // namespace concave_distance::demo::demo_paths_test
