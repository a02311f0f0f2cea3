#include <gtest/gtest.h>

#include <string>

#include "fcl_model.h"
#include "loading/query_poses.h"
#include "simulation/pose_path.h"

namespace concave_distance::demo::insertion_clearance_test {
namespace {

const std::string kFolder = std::string(CONCAVE_DISTANCE_SOURCE_DIR) + "/meshes/thesis/";

// Between hexagonal pins and holes, of circumradius 0.055 and 0.085, once the battery is aligned: the
// apothems differ by 0.03 cos 30 deg. The meshes are in single precision.
constexpr double kPinClearance = 0.0259807;

TEST(InsertionManoeuvre, KeepsClearOfTheFixtureThroughoutAtAThousandHertz) {
  const PosePath path(readPosePath(kFolder + "manoeuvre_200.csv"));
  const auto fixture = loadFclModel(kFolder + "fixture.stl");
  const auto battery = loadFclModel(kFolder + "battery.stl");
  double least = 1e9;
  double least_time = 0.0;
  for (int step = 0; step <= 20'000; ++step) {
    const double time = step * 1e-3;
    const double distance = fclDistance(*fixture, Eigen::Isometry3d::Identity(), *battery, path.poseAt(time));
    if (distance < least) {
      least = distance;
      least_time = time;
    }
  }
  EXPECT_NEAR(least, kPinClearance, 1e-6) << "at " << least_time << " s";
}

TEST(InsertionManoeuvre, HasTwoHundredStepsAtTenHertzThatEndInserted) {
  const PosePath path(readPosePath(kFolder + "manoeuvre_200.csv"));
  EXPECT_DOUBLE_EQ(path.startTime(), 0.1);
  EXPECT_DOUBLE_EQ(path.endTime(), 20.0);
  EXPECT_TRUE(path.poseAt(20.0).linear().isIdentity(1e-12));
  // Approach with rotation, then a straight insertion.
  EXPECT_GT(Eigen::AngleAxisd(path.poseAt(0.1).linear()).angle(), 1.0);
  EXPECT_TRUE(path.poseAt(10.0).linear().isIdentity(1e-12));
  EXPECT_LT(path.poseAt(20.0).translation().z(), 0.1);
}

}  // namespace
}  // namespace concave_distance::demo::insertion_clearance_test
