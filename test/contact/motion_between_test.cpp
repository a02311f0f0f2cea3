#include "contact/motion_between.h"

#include <gtest/gtest.h>

namespace concave_distance::motion_between_test {
namespace {

TEST(MotionBetween, IsTheWayOverTheTimeWithoutATurn) {
  const Eigen::Isometry3d before(Eigen::Translation3d(1.0, 2.0, 3.0));
  const Eigen::Isometry3d after(Eigen::Translation3d(1.5, 2.0, 2.0));
  const RelativeTwist twist = motionBetween(before, after, 0.5);
  EXPECT_EQ(twist.linear, Eigen::Vector3d(1.0, 0.0, -2.0));
  EXPECT_EQ(twist.angular, Eigen::Vector3d::Zero());
}

TEST(MotionBetween, FindsASteadyTurnAboutAnyAxis) {
  const Eigen::Vector3d centre(3.0, -1.0, 2.0);
  const Eigen::Vector3d axis = Eigen::Vector3d(1.0, 2.0, -1.0).normalized();
  const Eigen::Isometry3d before =
      Eigen::Translation3d(1.0, 1.0, 1.0) * Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX());
  const double speed = 2.0;  // rad/s
  for (const double seconds : {1e-2, 1e-3}) {
    const double angle = speed * seconds;
    const Eigen::Isometry3d turn =
        Eigen::Translation3d(centre) * Eigen::AngleAxisd(angle, axis) * Eigen::Translation3d(-centre);
    const RelativeTwist twist = motionBetween(before, turn * before, seconds);
    // A chord is shorter than its arc by angle^2 / 24; the middle of it nearer to the axis by angle^2 / 8.
    const double bound = speed * 3.0 * angle * angle + 1e-12 / seconds;
    EXPECT_NEAR((twist.angular - speed * axis).norm(), 0.0, 1e-12 / seconds);
    EXPECT_NEAR(twist.at(centre).norm(), 0.0, bound);
  }
}

TEST(MotionBetween, IsZeroWhereNoTimeHasPassed) {
  const Eigen::Isometry3d before = Eigen::Isometry3d::Identity();
  const Eigen::Isometry3d after(Eigen::Translation3d(1.0, 0.0, 0.0));
  for (const double seconds : {0.0, -1.0}) {
    EXPECT_EQ(motionBetween(before, after, seconds).linear, Eigen::Vector3d::Zero());
  }
}

}  // namespace
}  // namespace concave_distance::motion_between_test
