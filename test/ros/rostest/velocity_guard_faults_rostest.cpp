// A velocity guard that is given wrong rows, wrong commands, wrong clocks and wrong parameters.
#include <concave_distance/Constraints.h>
#include <concave_distance/GuardState.h>
#include <gtest/gtest.h>
#include <std_msgs/Float64.h>
#include <std_msgs/Float64MultiArray.h>

#include <cmath>

#include "rostest_support.h"
#include "run_node.h"
#include "simulated_clock.h"

namespace concave_distance::velocity_guard_faults_rostest {
namespace {

class GuardFaultsTest : public ::testing::Test {
 protected:
  GuardFaultsTest() {
    clock.set(100.0);
    EXPECT_TRUE(eventually([] { return ros::Time::now().toSec() > 99.0; }));
    rows.joints = {"lift", "turn"};
    rows.header.frame_id = "world";
    rows.rows.resize(2);
    Constraint& row = rows.rows[0];
    row.state = Constraint::USED;
    row.pair = "arm/shelf";
    row.value = 0.5;
    row.jacobian = {-1.0, 0.0};
    row.has_drift = 1;
    row.drift = row.drift_a = row.drift_b = 0.0;
    command = {-0.1, 0.0};
    timer = node.createWallTimer(ros::WallDuration(0.01), [this](const auto&) { publish(); });
    EXPECT_TRUE(eventually([this] { return state.last() && state.last()->scale == 1.0; }))
        << (state.last() ? state.last()->reason : "no state");
  }
  ~GuardFaultsTest() override { timer.stop(); }

  void publish() {
    const std::lock_guard<std::mutex> lock(mutex);
    if (sends_rows) {
      rows.header.stamp = ros::Time::now();
      rows.transforms = rows.header.stamp + ros::Duration(ahead);
      row_publisher.publish(rows);
    }
    std_msgs::Float64MultiArray message;
    message.data = command;
    command_publisher.publish(message);
  }
  template <typename Change>
  void change(Change act) {
    const std::lock_guard<std::mutex> lock(mutex);
    act();
  }
  void expectStop(const std::string& part) {
    state.clear();
    EXPECT_TRUE(state.waitFor([&](const GuardState& message) {
      return message.scale == 0.0 && message.reason.find(part) != std::string::npos;
    })) << (state.last() ? state.last()->reason : "no state");
    EXPECT_TRUE(eventually([this] { return scale.last() && scale.last()->data == 0.0; }));
  }

  ros::NodeHandle node;
  SimulatedClock clock;
  std::mutex mutex;
  Constraints rows;
  std::vector<double> command;
  double ahead = 0.0;
  bool sends_rows = true;
  Collector<GuardState> state{"/guard/state"};
  Collector<std_msgs::Float64> scale{"/guard/scale"};
  ros::Publisher row_publisher = node.advertise<Constraints>("/rows", 1);
  ros::Publisher command_publisher =
      node.advertise<std_msgs::Float64MultiArray>("/guard/joint_velocities", 1);
  ros::WallTimer timer;
};

TEST_F(GuardFaultsTest, StopsForCommandsThatAreNone) {
  change([this] { command = {std::nan(""), 0.0}; });
  expectStop("joint 'lift' is not finite");
  change([this] { command = {0.1}; });
  expectStop("the command has 1 numbers; ~joints names 2 joints");
  change([this] { command = {}; });
  expectStop("the command has 0 numbers");
  change([this] { command = {-0.1, 0.0}; });
  EXPECT_TRUE(state.waitFor([](const GuardState& message) { return message.scale == 1.0; }));
}

TEST_F(GuardFaultsTest, StopsForRowsThatAreNone) {
  change([this] { rows.rows[0].value = std::nan(""); });
  expectStop("pair arm/shelf: a number of its row is not finite");
  change([this] {
    rows.rows[0].value = 0.5;
    rows.rows[0].jacobian = {-1.0};
  });
  expectStop("pair arm/shelf");
  change([this] {
    rows.rows[0].jacobian = {-1.0, 0.0};
    rows.rows[0].overlapping = 1;
  });
  expectStop("set expert/signed_values");
  change([this] {
    rows.rows[0].overlapping = 0;
    rows.joints = {"lift", "swing"};
  });
  expectStop("joint 'turn' is not among the joints of the rows");
  change([this] {
    rows.joints = {"lift", "turn"};
    rows.problems = {"robot 'arm': no pose of link 'hand'"};
  });
  expectStop("no pose of link 'hand'");
  change([this] {
    rows.problems.clear();
    UnlistedPair pair;
    pair.pair = "arm/door";
    pair.reason = UnlistedPair::UNSOLVED;
    rows.unlisted = {pair};
  });
  expectStop("pair arm/door: it has no answer");
  change([this] { rows.unlisted[0].reason = 200; });
  expectStop("pair arm/door: more pairs are near");
  change([this] {
    command = {0.1, 0.0};
    rows.unlisted.clear();
    rows.rows[0].drift = rows.rows[0].drift_a = std::nan("");
  });
  expectStop("what moves there by itself is not known yet");
}

TEST_F(GuardFaultsTest, BoundsPlacesThatAreNotListed) {
  UnlistedPair pair;
  pair.pair = "arm/door";
  pair.reason = UnlistedPair::UNFINISHED;
  pair.has_lower_bound = 1;
  pair.lower_bound = 0.03;
  pair.reach = {1.0, 2.0};
  change([&] {
    rows.unlisted = {pair};
    command = {-0.1, 0.2};
  });
  // 0.5 m/s at most with 0.01 m left.
  const double lag = 0.05 * std::exp(1.0);
  const double expected = (-lag + std::sqrt(lag * lag + 4.0 * 0.125 * 0.01)) / (2.0 * 0.125);
  EXPECT_TRUE(state.waitFor([&](const GuardState& message) {
    return std::abs(message.scale - expected) < 1e-9 && message.reason.rfind("pair arm/door: ", 0) == 0 &&
           message.reason.find("0.5 m/s at most") != std::string::npos &&
           message.reason.find("not finished") != std::string::npos;
  })) << state.last()->reason;
}

TEST_F(GuardFaultsTest, StopsWhenRowsAreOldOrFromTheFuture) {
  change([this] { sends_rows = false; });
  expectStop("s old; ~stale_after is 0.2 s");
  change([this] {
    sends_rows = true;
    ahead = 5.0;
  });
  expectStop("~stale_after");
  change([this] { ahead = -1.0; });
  expectStop("~stale_after");
}

TEST_F(GuardFaultsTest, StopsWhenTheClockJumpsBackAndGoesOnWithNewRows) {
  state.clear();
  clock.set(50.0);
  EXPECT_TRUE(state.match([](const GuardState& message) {
    return message.scale == 0.0 && message.header.stamp.toSec() < 60.0;
  })) << "it begins anew";
  EXPECT_TRUE(state.waitFor(
      [](const GuardState& message) { return message.scale == 1.0 && message.header.stamp.toSec() < 60.0; }));
}

TEST(GuardFaults, WrongParametersEndTheNode) {
  // Parameters of a command line stay on the server: each run has a name of its own.
  int count = 0;
  const auto run = [&](const std::string& arguments) {
    return runNode("__name:=wrong_" + std::to_string(++count) + " " + arguments, "velocity_guard");
  };
  const auto expect = [](const Ended& ended, const std::string& part) {
    EXPECT_EQ(ended.exit_code, 1) << ended.output;
    EXPECT_NE(ended.output.find(part), std::string::npos) << ended.output;
  };
  expect(run("_joints:=lift _twist_frame:=tip"), "~twist_frame");
  expect(run("_joints:=lift _margin:=-1"), "~margin");
  expect(run("_joints:=lift _deceleration:=0"), "~deceleration");
  expect(run("_joints:=lift _rate:=fast"), "~rate");
  expect(run("_twist_frame:=/"), "~twist_frame");
}

}  // namespace
}  // namespace concave_distance::velocity_guard_faults_rostest
