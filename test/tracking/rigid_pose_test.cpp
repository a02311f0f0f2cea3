#include "tracking/rigid_pose.h"

#include <gtest/gtest.h>

#include <limits>

namespace concave_distance::rigid_pose_test {
namespace {

TEST(RigidPose, RefusesWhatIsNoRotation) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  EXPECT_TRUE(rigidPose(pose));
  pose.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(rigidPose(pose));
  pose = Eigen::Isometry3d::Identity();
  pose.linear() *= 1.01;
  EXPECT_FALSE(rigidPose(pose));
  pose.linear() = -Eigen::Matrix3d::Identity();
  EXPECT_FALSE(rigidPose(pose));
  pose.linear().setZero();
  EXPECT_FALSE(rigidPose(pose));
}

TEST(RigidPose, RefusesTranslationsWhoseProductsOverflow) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (const double far : {1.1e18, 1e154, 1e200, std::numeric_limits<double>::infinity()}) {
    pose.translation().y() = -far;
    EXPECT_FALSE(rigidPose(pose)) << far;
  }
  pose.translation().y() = -1e18;
  EXPECT_TRUE(rigidPose(pose));
}

TEST(RigidPose, MendsRounding) {
  Eigen::Isometry3d pose(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, 2.0, 3.0).normalized()));
  pose.linear() *= 1.0001;
  const auto mended = rigidPose(pose);
  ASSERT_TRUE(mended);
  EXPECT_LE((mended->linear() * mended->linear().transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-15);
}

}  // namespace
}  // namespace concave_distance::rigid_pose_test
