#include "ros/tf/tf_poses.h"

#include <gtest/gtest.h>

#include <limits>

#include "ros/seconds_text.h"
#include "ros/transform_message.h"

namespace concave_distance::tf_poses_test {
namespace {

const ros::Time kStart(100, 0);

void put(tf2::BufferCore& buffer, const std::string& parent, const std::string& child, double x,
         ros::Time stamp, bool fixed = false) {
  buffer.setTransform(test::transformOf(child, x, stamp, parent), "test", fixed);
}

PairTransforms look(const tf2::BufferCore& buffer, const PairFrames& frames, ros::Time now,
                    double stale_after) {
  PairAncestors ancestors;
  return lookUpPair(buffer, frames, now, stale_after, ancestors);
}

ros::Time at(double seconds) {
  return kStart + ros::Duration(seconds);
}

TEST(SecondsText, HasMilliseconds) {
  EXPECT_EQ(secondsText(3.0), "3");
  EXPECT_EQ(secondsText(2.04812), "2.048");
  EXPECT_EQ(secondsText(123456.7891), "123456.789");
}

TEST(TfPoses, TakeTheNewestTimeCommonToBothBodiesAndTheReference) {
  tf2::BufferCore buffer;
  for (int i = 0; i <= 10; ++i) {
    put(buffer, "world", "base", 0.0, at(0.1 * i));
  }
  for (int i = 0; i <= 20; ++i) {
    put(buffer, "base", "a", 1.0, at(0.1 * i));
    put(buffer, "base", "b", 1.0 + 0.1 * i, at(0.1 * i));
  }
  const PairTransforms transforms = look(buffer, {"world", "a", "b"}, at(2.0), 10.0);
  ASSERT_EQ(transforms.status, TransformStatus::Ok) << transforms.message;
  EXPECT_EQ(transforms.stamp, at(1.0)) << "the reference frame is known no further";
  EXPECT_NEAR(transforms.a_from_b.translation().x(), 1.0, 1e-9);
  EXPECT_NEAR(transforms.reference_from_a.translation().x(), 1.0, 1e-9);
  EXPECT_FALSE(transforms.fixed);
}

TEST(TfPoses, StaticFramesAreOfTheTimeAskedAtAndNeverStale) {
  tf2::BufferCore buffer;
  put(buffer, "world", "a", 1.0, kStart, true);
  put(buffer, "world", "b", 3.0, kStart, true);
  const PairTransforms transforms = look(buffer, {"world", "a", "b"}, at(1e4), 1.0);
  ASSERT_EQ(transforms.status, TransformStatus::Ok) << transforms.message;
  EXPECT_TRUE(transforms.fixed);
  EXPECT_EQ(transforms.stamp, at(1e4));
  EXPECT_NEAR(transforms.a_from_b.translation().x(), 2.0, 1e-12);
}

TEST(TfPoses, SayMissingWithTheFramesName) {
  tf2::BufferCore buffer;
  put(buffer, "world", "a", 1.0, kStart);
  const PairTransforms transforms = look(buffer, {"world", "a", "nowhere"}, at(0.0), 1.0);
  EXPECT_EQ(transforms.status, TransformStatus::Missing);
  EXPECT_NE(transforms.message.find("nowhere"), std::string::npos) << transforms.message;
  EXPECT_EQ(look(buffer, {"universe", "a", "world"}, at(0.0), 1.0).status, TransformStatus::Missing);
  EXPECT_EQ(look(buffer, {"world", "", "a"}, at(0.0), 1.0).status, TransformStatus::Missing);
  EXPECT_EQ(look(buffer, {"world", "/a", "a"}, at(0.0), 1.0).status, TransformStatus::Missing);
}

TEST(TfPoses, SayStaleWithTheAge) {
  tf2::BufferCore buffer;
  put(buffer, "world", "a", 1.0, kStart);
  put(buffer, "world", "b", 2.0, kStart);
  put(buffer, "world", "b", 2.0, at(3.0));
  const PairTransforms transforms = look(buffer, {"world", "a", "b"}, at(3.0), 1.0);
  EXPECT_EQ(transforms.status, TransformStatus::Stale);
  EXPECT_EQ(transforms.stamp, kStart);
  EXPECT_NE(transforms.message.find("3 s old"), std::string::npos) << transforms.message;
}

TEST(TfPoses, AnswerAtAGivenTimeOrSayWhyNot) {
  tf2::BufferCore buffer;
  put(buffer, "world", "a", 0.0, at(0.0));
  put(buffer, "world", "a", 1.0, at(1.0));
  put(buffer, "world", "b", 5.0, kStart, true);
  const PairTransforms transforms = lookUpPairAt(buffer, {"world", "a", "b"}, at(0.5));
  ASSERT_EQ(transforms.status, TransformStatus::Ok) << transforms.message;
  EXPECT_NEAR(transforms.a_from_b.translation().x(), 4.5, 1e-9);
  EXPECT_EQ(lookUpPairAt(buffer, {"world", "a", "b"}, at(1.5)).status, TransformStatus::Missing);
}

TEST(TfPoses, LoseNoDigitsToAFarReferenceFrame) {
  tf2::BufferCore buffer;
  put(buffer, "world", "base", 1e9, kStart);
  put(buffer, "base", "a", 0.1, kStart);
  put(buffer, "base", "b", 0.3, kStart);
  const PairTransforms transforms = look(buffer, {"world", "a", "b"}, kStart, 1.0);
  // One subtraction of numbers below 1; through the world frame 1e9 would leave 1e-7.
  EXPECT_NEAR(transforms.a_from_b.translation().x(), 0.2, std::numeric_limits<double>::epsilon());
}

TEST(TfPoses, KnowTheNearestCommonAncestor) {
  tf2::BufferCore buffer;
  put(buffer, "world", "base", 0.0, kStart);
  put(buffer, "base", "arm", 0.0, kStart);
  put(buffer, "arm", "a", 0.0, kStart);
  put(buffer, "base", "b", 0.0, kStart, true);
  put(buffer, "moon", "crater", 0.0, kStart);
  EXPECT_EQ(commonAncestor(buffer, "a", "b"), "base");
  EXPECT_EQ(commonAncestor(buffer, "a", "arm"), "arm");
  EXPECT_EQ(commonAncestor(buffer, "a", "a"), "a");
  EXPECT_EQ(commonAncestor(buffer, "a", "crater"), "");
  EXPECT_EQ(commonAncestor(buffer, "a", "nowhere"), "");
}

TEST(TfPoses, FindTheWayAgainWhenTheTreeChanges) {
  tf2::BufferCore buffer;
  put(buffer, "world", "base", 1.0, kStart);
  put(buffer, "base", "a", 1.0, kStart);
  put(buffer, "base", "b", 2.0, kStart);
  PairAncestors ancestors;
  ASSERT_EQ(lookUpPair(buffer, {"world", "a", "b"}, kStart, 1.0, ancestors).status, TransformStatus::Ok);
  EXPECT_EQ(ancestors.of_bodies, "base");
  put(buffer, "world", "a", 5.0, at(1.0));  // picked up: it does not hang on the base any more
  put(buffer, "world", "base", 1.0, at(1.0));
  put(buffer, "base", "b", 2.0, at(1.0));
  const PairTransforms transforms = lookUpPair(buffer, {"world", "a", "b"}, at(1.0), 1.0, ancestors);
  ASSERT_EQ(transforms.status, TransformStatus::Ok) << transforms.message;
  EXPECT_NEAR(transforms.a_from_b.translation().x(), -2.0, 1e-12);
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
