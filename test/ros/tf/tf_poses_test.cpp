#include "ros/tf/tf_poses.h"

#include <gtest/gtest.h>

#include "ros/seconds_text.h"

namespace concave_distance::tf_poses_test {
namespace {

TEST(SecondsText, HasMilliseconds) {
  EXPECT_EQ(secondsText(3.0), "3");
  EXPECT_EQ(secondsText(2.04812), "2.048");
  EXPECT_EQ(secondsText(123456.7891), "123456.789");
}

TEST(TfPoses, WaitNoLongerThanTold) {
  const TransformBuffer buffer({10.0, 1.0});
  const ros::WallTime start = ros::WallTime::now();
  waitForFrames(buffer, "a", "b", ros::Time(0), 0.05);
  const double waited = (ros::WallTime::now() - start).toSec();
  EXPECT_GE(waited, 0.05);
  EXPECT_LT(waited, 1.0);
}

}  // namespace
}  // namespace concave_distance::tf_poses_test
