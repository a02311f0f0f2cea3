// The node under transforms that cannot be right and a clock that jumps: it refuses, says so, and goes on.
#include <concave_distance/GetDistance.h>
#include <concave_distance/PairDistance.h>
#include <gtest/gtest.h>
#include <ros/init.h>
#include <tf2_msgs/TFMessage.h>

#include <cmath>
#include <limits>
#include <string>

#include "node_access.h"
#include "ros/transform_message.h"
#include "simulated_clock.h"
#include "tf_player.h"

namespace concave_distance::hostile_tf_rostest {
namespace {

using test::transformOf;

class HostileTfTest : public ::testing::Test {
 protected:
  HostileTfTest() {
    clock.set(start);
    player.place("box_a", 0.0);
    player.place("box_b", 2.0);
    EXPECT_TRUE(hostile.getNumSubscribers() > 0 ||
                eventually([&] { return hostile.getNumSubscribers() > 0; }));
    EXPECT_TRUE(isFollowed(2.0));
  }

  // The pair is solved at this distance, with a stamp of the present.
  bool isFollowed(double x) {
    player.place("box_b", x);
    return distance.waitFor([&](const PairDistance& message) {
      return message.status.code == PairStatus::OK && std::abs(message.distance - (x - 1.0)) < kRounding &&
             std::abs((ros::Time::now().toSec() - message.header.stamp.toSec())) < 1.0;
    });
  }
  void send(const geometry_msgs::TransformStamped& transform) {
    tf2_msgs::TFMessage message;
    message.transforms.push_back(transform);
    hostile.publish(message);
  }
  // The node has seen and counted what was sent. The publisher's name is this program's.
  void expectRefusal(const std::string& part) {
    EXPECT_TRUE(diagnostics.waitFor([&](const diagnostic_msgs::DiagnosticArray& message) {
      const std::string refusal = diagnosed(message, "last refusal");
      return refusal.find(part) != std::string::npos &&
             refusal.find("from " + ros::this_node::getName()) != std::string::npos;
    })) << part
        << "; the last: " << (diagnostics.last() ? diagnosed(*diagnostics.last(), "last refusal") : "");
  }

  const double start = 1000.0;
  ros::NodeHandle node;
  SimulatedClock clock;
  TfPlayer player;
  ros::Publisher hostile = node.advertise<tf2_msgs::TFMessage>("/tf", 100);
  Collector<PairDistance> distance{kNode + "pairs/boxes/distance"};
  Collector<diagnostic_msgs::DiagnosticArray> diagnostics{"/diagnostics"};
};

TEST_F(HostileTfTest, OneTransformFromTheFutureDoesNotFreezeAPair) {
  send(transformOf("box_b", 9.0, ros::Time::now() + ros::Duration(1000.0)));
  expectRefusal("ahead of the clock");
  EXPECT_TRUE(isFollowed(3.0));
  EXPECT_TRUE(isFollowed(4.0));
}

TEST_F(HostileTfTest, StampsThatRosCannotSubtractDoNotEndTheNode) {
  for (const std::uint32_t seconds : {2147484700U, 3000000000U, 4294967295U}) {
    send(transformOf("box_b", 9.0, ros::Time(seconds, 0)));
  }
  expectRefusal("ahead of the clock");
  EXPECT_TRUE(isFollowed(3.0));
}

TEST_F(HostileTfTest, ImpossiblePosesAndFramesAreRefused) {
  send(transformOf("box_b", 1e200, ros::Time::now()));
  expectRefusal("translation");
  send(transformOf("box_b", std::nan(""), ros::Time::now()));
  send(transformOf("box_b", std::numeric_limits<double>::infinity(), ros::Time::now()));
  geometry_msgs::TransformStamped turned = transformOf("box_b", 9.0, ros::Time::now());
  turned.transform.rotation.w = 0.0;
  send(turned);
  expectRefusal("quaternion");
  send(transformOf("box_b", 9.0, ros::Time::now(), "box_b"));
  expectRefusal("own parent");
  send(transformOf("world", 9.0, ros::Time::now(), "box_b"));
  expectRefusal("loop");
  EXPECT_TRUE(isFollowed(3.0));
}

TEST_F(HostileTfTest, AReferenceFrameWithAParentKeepsEveryAnswerFresh) {
  send(transformOf("world", 5.0, ros::Time::now() - ros::Duration(8.0), "map"));
  EXPECT_TRUE(isFollowed(3.0));
  GetDistanceRequest request;
  request.query.body_a = "box_a";
  request.query.body_b = "box_b";
  request.query.use_pose_a = 1;
  request.query.pose_a.pose.orientation.w = 1.0;
  const GetDistanceResponse response = call<GetDistance>(kNode + "get_distance", request);
  EXPECT_TRUE(response.success) << response.message;
  EXPECT_NEAR(response.result.nearest.distance, 2.0, kRounding);
}

TEST_F(HostileTfTest, AClockThatJumpsFarAheadAndReturnsIsSurvived) {
  for (const double jump : {4.0e9, 2147485000.0, 4294967290.0}) {
    clock.set(jump);
    EXPECT_TRUE(eventually([&] { return ros::Time::now().toSec() > 0.5 * jump; }));
    ros::WallDuration(0.2).sleep();  // some cycles at that time
    clock.set(start);
    EXPECT_TRUE(eventually([&] { return ros::Time::now().toSec() < 2.0 * start; }));
    EXPECT_TRUE(isFollowed(3.0)) << jump;
    EXPECT_TRUE(isFollowed(2.0)) << jump;
  }
}

TEST_F(HostileTfTest, AQueryAtAnImpossibleTimeIsAnswered) {
  GetDistanceRequest request;
  request.query.body_a = "box_a";
  request.query.body_b = "box_b";
  for (const std::uint32_t seconds : {1U, 2147484700U, 4294967295U}) {
    request.query.stamp = ros::Time(seconds, 0);
    const GetDistanceResponse response = call<GetDistance>(kNode + "get_distance", request);
    EXPECT_FALSE(response.success);
    EXPECT_EQ(response.result.nearest.status.code, PairStatus::MISSING_TRANSFORM) << response.message;
  }
  EXPECT_TRUE(isFollowed(3.0));
}

}  // namespace
}  // namespace concave_distance::hostile_tf_rostest
