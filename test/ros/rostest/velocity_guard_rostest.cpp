// The velocity guard beside a running distance node: joint velocities, a twist, measured speeds alone.
#include <concave_distance/GuardState.h>
#include <concave_distance/RemoveBody.h>
#include <geometry_msgs/TwistStamped.h>
#include <gtest/gtest.h>
#include <std_msgs/Float64.h>
#include <std_msgs/Float64MultiArray.h>

#include <cmath>

#include "node_access.h"
#include "started_node.h"
#include "tf_player.h"

namespace concave_distance::velocity_guard_rostest {
namespace {

/// Publishes a message again and again while it lives, as a driver does.
template <typename Message>
class Driver {
 public:
  Driver(const std::string& topic, const Message& message)
      : publisher_(node_.advertise<Message>(topic, 1)),
        timer_(node_.createWallTimer(ros::WallDuration(0.02),
                                     [this, message](const auto&) { publisher_.publish(message); })) {}

 private:
  ros::NodeHandle node_;
  ros::Publisher publisher_;
  ros::WallTimer timer_;
};

std_msgs::Float64MultiArray velocities(std::vector<double> values) {
  std_msgs::Float64MultiArray message;
  message.data = std::move(values);
  return message;
}

geometry_msgs::TwistStamped along(double x, const std::string& frame = "") {
  geometry_msgs::TwistStamped twist;
  twist.header.frame_id = frame;
  twist.twist.linear.x = x;
  return twist;
}

bool isFree(const GuardState& state) {
  return state.scale == 1.0 && state.reason == "nothing that closes is near";
}
bool startsWith(const GuardState& state, const std::string& part) {
  return state.reason.rfind(part, 0) == 0;
}

/// The scale of 1 m/s with so much room, 0.1 s and 1 m/s^2.
double scaleAt(double room) {
  const double lag = 0.1 * std::exp(1.0);
  return -lag + std::sqrt(lag * lag + 2.0 * room);
}

class VelocityGuardTest : public ::testing::Test {
 protected:
  VelocityGuardTest() {
    for (const std::string prefix : {"l_", "r_"}) {
      const double y = prefix == "l_" ? 0.0 : 10.0;
      player.place(prefix + "base", 0.0, y);
      player.place(prefix + "slide", 1.0, y);
      player.place(prefix + "tip", 2.0, y);
    }
    player.place("cart", 3.3);  // 0.3 m before the tip
  }

  TfPlayer player;
};

TEST_F(VelocityGuardTest, SlowsTheApproachAndNoRetreat) {
  Collector<GuardState> state("/joint_guard/state");
  Collector<std_msgs::Float64> scale("/joint_guard/scale");
  const double expected = scaleAt(0.2);
  const auto is_slow = [&](const auto& message) { return std::abs(message.scale - expected) < 1e-6; };
  {
    const Driver<std_msgs::Float64MultiArray> driver("/joint_guard/joint_velocities", velocities({0.4, 0.6}));
    EXPECT_TRUE(state.waitFor(is_slow)) << state.last().value_or(GuardState()).reason;
    const std::string reason = state.last()->reason;
    EXPECT_EQ(reason.rfind("pair ", 0), 0U) << reason;
    EXPECT_NE(reason.find("l_tip"), std::string::npos) << reason;
    EXPECT_NE(reason.find(": closes at 1 m/s with 0.2"), std::string::npos) << reason;
    EXPECT_NE(reason.find(" m to stop"), std::string::npos) << reason;
    EXPECT_TRUE(scale.waitFor(
        [&](const std_msgs::Float64& message) { return std::abs(message.data - expected) < 1e-6; }));
  }
  const Driver<std_msgs::Float64MultiArray> driver("/joint_guard/joint_velocities", velocities({-0.4, -0.6}));
  EXPECT_TRUE(state.waitFor(isFree));
}

TEST_F(VelocityGuardTest, CountsAnOldCommandAsZeros) {
  Collector<GuardState> state("/joint_guard/state");
  {
    const Driver<std_msgs::Float64MultiArray> driver("/joint_guard/joint_velocities", velocities({1.0, 0.0}));
    ASSERT_TRUE(state.waitFor([](const GuardState& message) { return message.scale < 0.5; }));
  }
  EXPECT_TRUE(state.waitFor(isFree));
}

TEST_F(VelocityGuardTest, ScalesATwistByTheLinkThatItMoves) {
  Collector<GuardState> state("/twist_guard/state");
  const double expected = scaleAt(0.2);
  const auto is_slow = [&](const GuardState& message) { return std::abs(message.scale - expected) < 1e-6; };
  {
    const Driver<geometry_msgs::TwistStamped> driver("/twist_guard/twist", along(1.0));
    EXPECT_TRUE(state.waitFor(is_slow)) << state.last().value_or(GuardState()).reason;
  }
  {
    const Driver<geometry_msgs::TwistStamped> driver("/twist_guard/twist", along(-1.0));
    EXPECT_TRUE(state.waitFor(isFree));
  }
  player.place("l_tip", 2.0, 0.0, 0.0, std::acos(-1.0) / 2.0);
  {
    const Driver<geometry_msgs::TwistStamped> driver("/twist_guard/twist", along(1.0));
    ASSERT_TRUE(state.waitFor(isFree)) << "x of the turned link is along the cart's face";
  }
  {
    const Driver<geometry_msgs::TwistStamped> driver("/twist_guard/twist", along(1.0, "/cart"));
    EXPECT_TRUE(state.waitFor(is_slow)) << "x of the cart is not: " << state.last()->reason;
  }
  const Driver<geometry_msgs::TwistStamped> driver("/twist_guard/twist", along(1.0, "nowhere"));
  EXPECT_TRUE(state.waitFor([](const GuardState& message) {
    return message.scale == 0.0 && startsWith(message, "the frame of the twist is not known: ");
  }));
}

// Of the launch file, which starts the guard alone.
TEST_F(VelocityGuardTest, ScalesByMeasuredSpeedsOnTheTopicOfServo) {
  Collector<std_msgs::Float64> scale("/servo_server/internal/collision_velocity_scale");
  EXPECT_TRUE(scale.waitFor([](const std_msgs::Float64& message) { return message.data == 1.0; }));
  player.glide("l_tip", 1.0, 2.28, 1.0);  // at 1.28 m/s to 0.02 m before the cart
  EXPECT_TRUE(scale.match([](const std_msgs::Float64& message) { return message.data < 0.3; }).has_value());
}

TEST_F(VelocityGuardTest, StopsForALinkThatIsNotOnTf) {
  Collector<GuardState> state("/joint_guard/state");
  const Driver<std_msgs::Float64MultiArray> driver("/joint_guard/joint_velocities", velocities({-0.4, -0.6}));
  ASSERT_TRUE(state.waitFor([](const GuardState& message) { return message.scale == 1.0; }));
  player.drop("cart");
  EXPECT_TRUE(state.waitFor([](const GuardState& message) {
    return message.scale == 0.0 && startsWith(message, "body cart: it has no pose");
  })) << state.last()->reason;
  player.place("cart", 3.3);
  EXPECT_TRUE(state.waitFor([](const GuardState& message) { return message.scale == 1.0; }));
}

TEST_F(VelocityGuardTest, GoesOnWhenTheDistanceNodeIsRestarted) {
  Collector<GuardState> state("/restart_guard/state");
  EXPECT_TRUE(state.waitFor([](const GuardState& message) {
    return message.scale == 0.0 &&
           startsWith(message, "no rows have come yet; check the topic /restarted/constraints");
  }));
  for (int i = 0; i < 2; ++i) {
    const StartedNode node({"__name:=restarted", "_rate:=50"});
    EXPECT_TRUE(state.waitFor([](const GuardState& message) { return message.scale == 1.0; })) << i;
    state.clear();
  }
  EXPECT_TRUE(state.waitFor([](const GuardState& message) {
    return message.scale == 0.0 && message.reason.find("~stale_after is 0.2 s") != std::string::npos;
  }));
}

// The last test: the robot does not come back.
TEST_F(VelocityGuardTest, StopsForARobotThatHasLeft) {
  Collector<GuardState> state("/joint_guard/state");
  const Driver<std_msgs::Float64MultiArray> driver("/joint_guard/joint_velocities", velocities({-0.4, -0.6}));
  ASSERT_TRUE(state.waitFor([](const GuardState& message) { return message.scale == 1.0; }));
  for (const std::string body : {"l_base", "l_tip"}) {
    RemoveBodyRequest request;
    request.name = body;
    request.allow_robot_link = 1;
    const auto response = call<RemoveBody>(kNode + "remove_body", request);
    ASSERT_TRUE(response.success) << response.message;
  }
  EXPECT_TRUE(state.waitFor([](const GuardState& message) {
    return message.scale == 0.0 && startsWith(message, "joint 'l_base_slide' is not among the joints");
  })) << state.last()->reason;
}

}  // namespace
}  // namespace concave_distance::velocity_guard_rostest
