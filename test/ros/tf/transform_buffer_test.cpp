#include "ros/tf/transform_buffer.h"

#include <console_bridge/console.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "ros/located_pair.h"

namespace concave_distance::transform_buffer_test {
namespace {

using test::located;
using test::LocatedPair;
using test::transformOf;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class TransformBufferTest : public ::testing::Test {
 protected:
  ros::Time at(double seconds) const { return ros::Time(start.sec, 0) + ros::Duration(seconds); }

  bool put(const std::string& child, double x, ros::Time stamp, const std::string& parent = "world",
           bool fixed = false) {
    return put(transformOf(child, x, stamp, parent), fixed);
  }
  bool put(const geometry_msgs::TransformStamped& transform, bool fixed = false) {
    const auto problem = buffer.insert(transform, "/sender", fixed);
    last_problem = problem ? problem->what + " (" + problem->remedy + ")" : "";
    return !problem;
  }
  // Returns where a cycle sees b from a.
  LocatedPair look(const std::string& reference = "world") {
    return located(buffer.current(), reference, "a", "b", now, 1.0);
  }
  double gap() {
    const LocatedPair pair = look();
    return pair.place.status == TransformStatus::Ok ? pair.a_from_b.translation().x() : std::nan("");
  }
  void expectRefusal(const geometry_msgs::TransformStamped& transform, const std::string& part,
                     bool fixed = false) {
    EXPECT_FALSE(put(transform, fixed)) << part;
    EXPECT_NE(last_problem.find(part), std::string::npos) << last_problem;
  }

  const ros::Time start{1'700'000'000, 0};
  ros::Time now = start;
  TransformBuffer buffer{{10.0, 1.0}, [this] { return now; }};
  std::string last_problem;
};

TEST_F(TransformBufferTest, OneTransformFromTheFutureDoesNotHoldAFrameStill) {
  put("a", 0.0, now, "world", true);
  ASSERT_TRUE(put("b", 2.0, now));
  expectRefusal(transformOf("b", 9.0, at(1000.0)), "ahead");
  for (int step = 1; step <= 50; ++step) {
    now = at(0.1 * step);
    ASSERT_TRUE(put("b", 2.0 + step, now)) << last_problem;
    EXPECT_EQ(gap(), 2.0 + step) << "at " << 0.1 * step << " s";
  }
}

TEST_F(TransformBufferTest, AStampWithinTheToleranceDoesNotHoldAFrameStillEither) {
  put("a", 0.0, now, "world", true);
  put("b", 2.0, now);
  ASSERT_TRUE(put("b", 3.0, at(0.9))) << last_problem;
  for (int step = 1; step <= 8; ++step) {
    now = at(0.1 * step);
    put("b", 20.0 + step, now);
    EXPECT_EQ(gap(), 20.0 + step) << "at " << 0.1 * step << " s";
  }
  EXPECT_EQ(look().place.stamp, now);
}

TEST_F(TransformBufferTest, AFrameKnownOnlyAheadOfTheClockIsUsed) {
  put("a", 0.0, now, "world", true);
  ASSERT_TRUE(put("b", 2.0, at(0.5)));
  EXPECT_EQ(gap(), 2.0) << "as publishers that stamp ahead expect";
}

TEST_F(TransformBufferTest, StampsThatRosCannotSubtractAreRefused) {
  for (const double ahead : {2147483648.0, 2147483647.0, 2500000000.0}) {
    expectRefusal(transformOf("b", 1.0, ros::Time(static_cast<std::uint32_t>(1.7e9 + ahead), 0)), "ahead");
  }
  ros::Time stamp = now;
  stamp.nsec = 4'000'000'000U;
  expectRefusal(transformOf("b", 1.0, stamp), "nanoseconds");
  now = ros::Time(std::numeric_limits<std::uint32_t>::max() - 3, 0);
  expectRefusal(transformOf("b", 1.0, now), "beyond the range of ROS time");
}

TEST_F(TransformBufferTest, AStampFarBehindTheNewestIsRefusedAndARepeatedOneIgnored) {
  put("a", 0.0, now, "world", true);
  put("b", 1.0, now);
  EXPECT_TRUE(put("b", 2.0, now)) << last_problem;
  EXPECT_EQ(gap(), 1.0);
  expectRefusal(transformOf("b", 3.0, at(-11.0)), "older than");
}

// Counts what tf2 logs while it lives.
class CountedLog : public console_bridge::OutputHandler {
 public:
  CountedLog() { console_bridge::useOutputHandler(this); }
  ~CountedLog() override { console_bridge::restorePreviousOutputHandler(); }
  void log(const std::string& text, console_bridge::LogLevel /*level*/, const char* /*file*/,
           int /*line*/) override {
    lines.push_back(text);
  }
  std::vector<std::string> lines;
};

TEST_F(TransformBufferTest, ARepeatedStampIsIgnoredWithoutALineInTheLogWhicheverItIs) {
  CountedLog log;
  put("a", 0.0, now, "world", true);
  for (int step = 0; step < 10; ++step) put("b", step, at(0.1 * step - 1.0));
  for (int step = 9; step >= 0; --step) {
    EXPECT_TRUE(put("b", 100.0, at(0.1 * step - 1.0))) << last_problem;
  }
  EXPECT_TRUE(put("b", 4.5, at(-0.55))) << "one between them is taken";
  EXPECT_TRUE(put("b", 100.0, at(-0.55)));
  EXPECT_TRUE(log.lines.empty()) << log.lines.size() << " lines, the first: " << log.lines.front();
  EXPECT_EQ(gap(), 9.0);
  const auto before = buffer.current()->lookupTransform("a", "b", at(-0.55));
  EXPECT_NEAR(before.transform.translation.x, 4.5, 1e-12);
}

TEST_F(TransformBufferTest, StampsAreKnownAsLongAsTf2KeepsTheirTransforms) {
  CountedLog log;
  for (int step = 0; step <= 400; ++step) {
    now = at(0.05 * step);
    put("b", step, now);
    put("b", 0.0, at(0.05 * std::max(0, step - 190)));
    put("b", 0.0, at(0.05 * std::max(0, step - 200)));
  }
  EXPECT_TRUE(log.lines.empty()) << log.lines.size() << " lines, the first: " << log.lines.front();
}

TEST_F(TransformBufferTest, AStampOfZeroIsRefusedBecauseItWouldNeverBeStale) {
  expectRefusal(transformOf("b", 1.0, ros::Time(0)), "zero");
}

TEST_F(TransformBufferTest, ImpossiblePosesAreRefusedOnBothTopics) {
  for (const bool fixed : {false, true}) {
    for (const double value : {std::nan(""), kInfinity, -kInfinity, 1e200, 1.1e18}) {
      geometry_msgs::TransformStamped transform = transformOf("b", 0.0, now);
      transform.transform.translation.z = value;
      expectRefusal(transform, "translation", fixed);
    }
    for (const double w : {0.0, std::nan(""), kInfinity, 1.01, 0.99, 1e200}) {
      geometry_msgs::TransformStamped transform = transformOf("b", 0.0, now);
      transform.transform.rotation.w = w;
      expectRefusal(transform, "quaternion", fixed);
    }
  }
  EXPECT_EQ(buffer.frameCount(), 0U);
}

TEST_F(TransformBufferTest, ImpossibleFramesAreRefused) {
  for (const std::string& name : {std::string(), std::string("/"), std::string("//a"), std::string(1, '\0'),
                                  std::string("a\n"), std::string(300, 'x')}) {
    expectRefusal(transformOf(name, 0.0, now), "child_frame_id");
    expectRefusal(transformOf("b", 0.0, now, name), "frame_id");
  }
  expectRefusal(transformOf("b", 0.0, now, "b"), "own parent");
  expectRefusal(transformOf("/b", 0.0, now, "b"), "own parent");
  EXPECT_TRUE(put("a link", 0.0, now)) << "tf2 knows blanks: " << last_problem;
}

TEST_F(TransformBufferTest, QuaternionsThatAreOffByWhatTf2AllowsTurnAndDoNotScale) {
  put("a", 0.0, now, "world", true);
  geometry_msgs::TransformStamped transform = transformOf("b", 1.0, now);
  transform.transform.rotation.w = 1.004;
  ASSERT_TRUE(put(transform)) << last_problem;
  EXPECT_TRUE(look().a_from_b.linear().isIdentity(1e-15)) << look().a_from_b.matrix();
}

TEST_F(TransformBufferTest, NothingThatMovesIsTakenBeforeSimulatedTimeBegins) {
  now = ros::Time(0);
  expectRefusal(transformOf("b", 1.0, ros::Time(1.7e9)), "has not begun");
  EXPECT_TRUE(put("a", 0.0, ros::Time(1.7e9), "world", true)) << last_problem;
  now = ros::Time(10.0);
  EXPECT_TRUE(put("b", 1.0, now)) << last_problem;
  EXPECT_EQ(gap(), 1.0);
}

TEST_F(TransformBufferTest, AClockThatJumpsFarAndReturnsLeavesNothingBehind) {
  now = ros::Time(1000.0);
  put("a", 0.0, now, "world", true);
  put("b", 1.0, now);
  now = ros::Time(4.0e9);
  EXPECT_EQ(look().place.status, TransformStatus::Stale);
  EXPECT_TRUE(put("b", 2.0, now)) << last_problem;
  EXPECT_EQ(gap(), 2.0);
  now = ros::Time(1001.0);
  buffer.checkClock();
  EXPECT_EQ(look().place.status, TransformStatus::Missing) << "what was sent at 4e9 s is gone";
  expectRefusal(transformOf("b", 2.5, ros::Time(4.0e9)), "ahead");
  EXPECT_TRUE(put("b", 3.0, now)) << last_problem;
  EXPECT_EQ(gap(), 3.0) << "the fixed transform outlives both jumps";
}

TEST_F(TransformBufferTest, AReferenceFrameThatGetsAParentMakesNothingStale) {
  put("a", 0.0, now);
  put("b", 2.0, now);
  ASSERT_TRUE(put("world", 5.0, at(-8.0), "map"));
  EXPECT_EQ(gap(), 2.0);
  put("a", 0.0, now, "world");
  const LocatedPair in_world = located(buffer.current(), "world", "world", "b", now, 1.0);
  ASSERT_EQ(in_world.place.status, TransformStatus::Ok) << in_world.place.message;
  EXPECT_EQ(in_world.place.stamp, now);
  EXPECT_EQ(in_world.a_from_b.translation().x(), 2.0);
}

TEST_F(TransformBufferTest, AFarRootCostsTheReferenceFrameNoDigits) {
  put("odom", 1e9, now, "earth");
  put("reference", 0.1, now, "odom");
  put("a", 0.3, now, "odom");
  put("b", 0.7, now, "odom");
  EXPECT_NEAR(look("reference").place.target_from_source.translation().x(), 0.2, 1e-15);
}

TEST_F(TransformBufferTest, ALoopIsRefusedAndAnotherParentTaken) {
  put("a", 1.0, now);
  put("b", 1.0, now, "a");
  expectRefusal(transformOf("world", 0.0, now, "b"), "loop");
  expectRefusal(transformOf("a", 0.0, now, "b"), "loop");
  EXPECT_EQ(gap(), 1.0);
  now = at(0.1);
  EXPECT_TRUE(put("b", 5.0, now, "world")) << last_problem;
  put("a", 1.0, now);
  EXPECT_EQ(gap(), 4.0);
}

TEST_F(TransformBufferTest, AFrameThatWasFixedIsStaleWhenItMovesNoMore) {
  put("a", 0.0, now, "world", true);
  put("b", 1.0, now, "world", true);
  EXPECT_TRUE(look().fixed);
  now = at(0.1);
  expectRefusal(transformOf("b", 2.0, now), "on both");
  now = at(2.0);
  ASSERT_TRUE(put("b", 2.0, now)) << last_problem;
  EXPECT_EQ(gap(), 2.0);
  now = at(7.0);
  EXPECT_EQ(look().place.status, TransformStatus::Stale);
}

TEST_F(TransformBufferTest, AFrameThatMovedIsFixedWhenAStaticTransformSaysSo) {
  put("a", 0.0, now, "world", true);
  put("b", 1.0, now);
  now = at(0.1);
  expectRefusal(transformOf("b", 2.0, now), "on both", true);
  EXPECT_EQ(gap(), 1.0) << "one static transform too many does not stop what moves";
  now = at(100.0);
  ASSERT_TRUE(put("b", 2.0, now, "world", true)) << last_problem;
  EXPECT_EQ(gap(), 2.0);
}

TEST_F(TransformBufferTest, InventedNamesDoNotFillTheMemoryAndAreForgotten) {
  put("a", 0.0, now, "world", true);
  bool refused = false;
  for (int i = 0; i < 20'000; ++i) {
    refused = !put("invented_" + std::to_string(i), 0.0, now) || refused;
  }
  EXPECT_TRUE(refused);
  EXPECT_LE(buffer.frameCount(), 10'000U);
  now = at(60.0);
  EXPECT_TRUE(put("b", 1.0, now)) << last_problem;
  EXPECT_EQ(gap(), 1.0);
  for (int i = 0; i < 20'000; ++i) {
    put("c", 0.0, now, "parent_" + std::to_string(i));
  }
  EXPECT_TRUE(put("b", 2.0, now, "a")) << last_problem;
}

TEST(TransformsOfFarTimes, AreMissingAndDoNotThrow) {
  const auto core = std::make_shared<tf2::BufferCore>();
  core->setTransform(transformOf("a", 0.0, ros::Time(1000.0)), "test", false);
  core->setTransform(transformOf("b", 1.0, ros::Time(1000.0)), "test", false);
  const ros::Time far(4'000'000'000U, 0);
  for (const std::uint32_t seconds : {1U, 4'000'000'000U, 4'294'967'295U}) {
    const FrameTransform place = located(core, "world", "a", "b", far, 1.0, ros::Time(seconds, 0)).place;
    EXPECT_EQ(place.status, TransformStatus::Missing) << seconds;
    EXPECT_FALSE(place.message.empty());
  }
  EXPECT_EQ(located(core, "world", "a", "b", far, 1.0).place.status, TransformStatus::Stale);
}

}  // namespace
}  // namespace concave_distance::transform_buffer_test
