// The velocity guard beside a running distance node: joint velocities, a twist, measured speeds alone.
#include <concave_distance/GuardState.h>
#include <concave_distance/RemoveBody.h>
#include <geometry_msgs/Twist.h>
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

geometry_msgs::Twist along(double x) {
  geometry_msgs::Twist twist;
  twist.linear.x = x;
  return twist;
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
  Collector<std_msgs::Float64MultiArray> out("/joint_guard/joint_velocities_out");
  const double expected = scaleAt(0.2);
  {
    const Driver<std_msgs::Float64MultiArray> driver("/joint_guard/joint_velocities_in",
                                                     velocities({0.4, 0.6}));
    EXPECT_TRUE(state.waitFor([&](const GuardState& message) {
      return message.reason == GuardState::CLOSING && std::abs(message.scale - expected) < 1e-6;
    })) << state.last().value_or(GuardState()).message;
    const auto last = *state.last();
    EXPECT_NE(last.pair.find("l_tip"), std::string::npos) << last.pair;
    EXPECT_NEAR(last.room, 0.2, 1e-9);
    EXPECT_NEAR(last.closing, 1.0, 1e-9);
    EXPECT_NEAR(last.stopping_distance, 0.1 * std::exp(1.0) + 0.5, 1e-9);
    EXPECT_EQ(last.message.rfind("pair " + last.pair + ": closes at 1 m/s with 0.2", 0), 0U) << last.message;
    EXPECT_TRUE(out.waitFor([&](const std_msgs::Float64MultiArray& message) {
      return message.data.size() == 2 && std::abs(message.data[0] - 0.4 * expected) < 1e-6 &&
             std::abs(message.data[1] - 0.6 * expected) < 1e-6;
    })) << "the direction stays";
  }
  const Driver<std_msgs::Float64MultiArray> driver("/joint_guard/joint_velocities_in",
                                                   velocities({-0.4, -0.6}));
  EXPECT_TRUE(state.waitFor([](const GuardState& message) { return message.scale == 1.0; }));
  EXPECT_TRUE(out.waitFor([](const std_msgs::Float64MultiArray& message) {
    return message.data == std::vector<double>{-0.4, -0.6};
  }));
}

TEST_F(VelocityGuardTest, SendsZerosWhenCommandsStop) {
  Collector<std_msgs::Float64MultiArray> out("/joint_guard/joint_velocities_out");
  {
    const Driver<std_msgs::Float64MultiArray> driver("/joint_guard/joint_velocities_in",
                                                     velocities({-1.0, 0.0}));
    ASSERT_TRUE(
        out.waitFor([](const std_msgs::Float64MultiArray& message) { return message.data[0] == -1.0; }));
  }
  EXPECT_TRUE(out.waitFor([](const std_msgs::Float64MultiArray& message) {
    return message.data == std::vector<double>{0.0, 0.0};
  }));
}

TEST_F(VelocityGuardTest, ScalesATwistByTheLinkThatItMoves) {
  Collector<GuardState> state("/twist_guard/state");
  Collector<geometry_msgs::Twist> out("/twist_guard/cmd_vel_out");
  const double expected = scaleAt(0.2);
  {
    const Driver<geometry_msgs::Twist> driver("/twist_guard/cmd_vel_in", along(1.0));
    EXPECT_TRUE(out.waitFor([&](const geometry_msgs::Twist& message) {
      return std::abs(message.linear.x - expected) < 1e-6;
    })) << state.last().value_or(GuardState()).message;
  }
  {
    const Driver<geometry_msgs::Twist> driver("/twist_guard/cmd_vel_in", along(-1.0));
    EXPECT_TRUE(out.waitFor([&](const geometry_msgs::Twist& message) { return message.linear.x == -1.0; }));
  }
  player.place("l_tip", 2.0, 0.0, 0.0, std::acos(-1.0) / 2.0);
  const Driver<geometry_msgs::Twist> driver("/twist_guard/cmd_vel_in", along(1.0));
  EXPECT_TRUE(out.waitFor([&](const geometry_msgs::Twist& message) { return message.linear.x == 1.0; }))
      << "x of the turned link is along the cart's face";
}

TEST_F(VelocityGuardTest, ScalesByMeasuredSpeedsOnTheTopicOfServo) {
  Collector<std_msgs::Float64> scale("/servo_server/internal/collision_velocity_scale");
  EXPECT_TRUE(scale.waitFor([](const std_msgs::Float64& message) { return message.data == 1.0; }));
  player.glide("l_tip", 1.0, 2.28, 1.0);  // at 1.28 m/s to 0.02 m before the cart
  EXPECT_TRUE(scale.match([](const std_msgs::Float64& message) { return message.data < 0.3; }).has_value());
}

TEST_F(VelocityGuardTest, StopsForALinkThatIsNotOnTf) {
  Collector<GuardState> state("/joint_guard/state");
  const Driver<std_msgs::Float64MultiArray> driver("/joint_guard/joint_velocities_in",
                                                   velocities({-0.4, -0.6}));
  ASSERT_TRUE(state.waitFor([](const GuardState& message) { return message.scale == 1.0; }));
  player.drop("cart");
  EXPECT_TRUE(state.waitFor([](const GuardState& message) {
    return message.scale == 0.0 &&
           (message.reason == GuardState::STALE || message.reason == GuardState::UNKNOWN);
  }));
  EXPECT_TRUE(state.match([](const GuardState& message) {
    return message.reason == GuardState::UNKNOWN &&
           message.message.rfind("body cart: it has no pose", 0) == 0;
  })) << state.last()->message;
  player.place("cart", 3.3);
  EXPECT_TRUE(state.waitFor([](const GuardState& message) { return message.scale == 1.0; }));
}

TEST_F(VelocityGuardTest, GoesOnWhenTheDistanceNodeIsRestarted) {
  Collector<GuardState> state("/restart_guard/state");
  EXPECT_TRUE(state.waitFor([](const GuardState& message) {
    return message.scale == 0.0 && message.reason == GuardState::NO_ROWS &&
           message.message.find("check ~constraints_topic") != std::string::npos;
  }));
  for (int i = 0; i < 2; ++i) {
    const StartedNode node({"__name:=restarted", "_rate:=50"});
    EXPECT_TRUE(state.waitFor([](const GuardState& message) { return message.scale == 1.0; })) << i;
    state.clear();
  }
  EXPECT_TRUE(state.waitFor([](const GuardState& message) {
    return message.scale == 0.0 && message.reason == GuardState::STALE &&
           message.message.find("~stale_after is 0.2 s") != std::string::npos;
  }));
}

// The last test: the robot does not come back.
TEST_F(VelocityGuardTest, StopsForARobotThatHasLeft) {
  Collector<GuardState> state("/joint_guard/state");
  const Driver<std_msgs::Float64MultiArray> driver("/joint_guard/joint_velocities_in",
                                                   velocities({-0.4, -0.6}));
  ASSERT_TRUE(state.waitFor([](const GuardState& message) { return message.scale == 1.0; }));
  for (const std::string body : {"l_base", "l_tip"}) {
    RemoveBodyRequest request;
    request.name = body;
    request.allow_robot_link = 1;
    const auto response = call<RemoveBody>(kNode + "remove_body", request);
    ASSERT_TRUE(response.success) << response.message;
  }
  EXPECT_TRUE(state.waitFor([](const GuardState& message) {
    return message.scale == 0.0 && message.reason == GuardState::BAD_COMMAND &&
           message.message.rfind("joint 'l_base_slide' is not among the joints", 0) == 0;
  })) << state.last()->message;
}

}  // namespace
}  // namespace concave_distance::velocity_guard_rostest
