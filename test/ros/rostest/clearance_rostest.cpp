// Clearances of motions by a running node, good requests and bad.
#include <concave_distance/CancelClearance.h>
#include <concave_distance/ClearanceFeedback.h>
#include <concave_distance/Distances.h>
#include <concave_distance/GetClearance.h>
#include <concave_distance/RemoveBody.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <thread>

#include "node_access.h"
#include "tf_player.h"

namespace concave_distance::clearance_rostest {
namespace {

GetClearanceResponse ask(const GetClearanceRequest& request) {
  return call<GetClearance>(kNode + "get_clearance", request);
}

void expectRefusal(const GetClearanceRequest& request, const std::string& part) {
  const GetClearanceResponse response = ask(request);
  EXPECT_FALSE(response.success) << part;
  EXPECT_NE(response.message.find(part), std::string::npos) << response.message;
}

/// The left tip, 1.5 m before its first slide, goes from x = 2.5 to 4.5; the cart's side is at 5.5.
GetClearanceRequest approach() {
  GetClearanceRequest request;
  request.trajectory.joint_names = {"l_base_slide", "l_slide_tip"};
  request.trajectory.points.resize(2);
  request.trajectory.points[0].positions = {1.0, 1.5};
  request.trajectory.points[1].positions = {3.0, 1.5};
  request.trajectory.points[1].time_from_start = ros::Duration(4.0);
  return request;
}

/// The cart comes to the left tip at x = 2 along x, beside it in y.
GetClearanceRequest path() {
  GetClearanceRequest request;
  request.body = "cart";
  request.poses.resize(2);
  request.poses[0].pose.position.x = 6.0;
  request.poses[0].pose.position.y = 1.25;
  request.poses[1] = request.poses[0];
  request.poses[1].pose.position.x = -4.0;
  return request;
}

class ClearanceServiceTest : public ::testing::Test {
 protected:
  ClearanceServiceTest() {
    for (const std::string prefix : {"l_", "r_"}) {
      const double y = prefix == "l_" ? 0.0 : 10.0;
      player.place(prefix + "base", 0.0, y);
      player.place(prefix + "slide", 1.0, y);
      player.place(prefix + "tip", 2.0, y);
    }
    player.place("cart", 6.0);
    EXPECT_TRUE(eventually([] { return ask(approach()).success != 0; }));
  }

  TfPlayer player;
};

TEST_F(ClearanceServiceTest, AnswersForATrajectory) {
  GetClearanceRequest request = approach();
  request.with_first_time = true;
  request.threshold = 0.4;
  request.with_niches = true;
  const GetClearanceResponse response = ask(request);
  ASSERT_TRUE(response.success) << response.message;
  EXPECT_EQ(response.status, GetClearanceResponse::OK);
  EXPECT_NEAR(response.distance, 0.5, kRounding);
  EXPECT_LE(response.lower_bound, 0.5);
  EXPECT_GE(response.lower_bound, 0.5 - 1e-3);
  EXPECT_NEAR(response.time, 4.0, 1e-9);
  EXPECT_EQ(response.body_a, "l_tip");
  EXPECT_EQ(response.body_b, "cart");
  EXPECT_EQ(response.frame, "world");
  EXPECT_NEAR(response.point_b.x - response.point_a.x, 0.5, kRounding);
  EXPECT_FALSE(response.has_first_time) << "it is never below";
  EXPECT_GE(response.nearest.niches.size(), 1U);
  EXPECT_GT(response.pairs.size(), 1U);
  request.threshold = 1.0;
  const GetClearanceResponse below = ask(request);
  ASSERT_TRUE(below.has_first_time);
  EXPECT_LE(below.proven_until, 3.0 + 1e-9);
  EXPECT_GE(below.first_time, 3.0 - 1e-9);
  EXPECT_LT(below.first_time - below.proven_until, 0.01);
}

TEST_F(ClearanceServiceTest, AnswersForAPathOfPoses) {
  const GetClearanceResponse response = ask(path());
  ASSERT_TRUE(response.success) << response.message;
  EXPECT_NEAR(response.distance, 0.25, kRounding) << response.body_a << " and " << response.body_b;
  EXPECT_GE(response.lower_bound, 0.25 - 1e-3);
  GetClearanceRequest through = path();
  through.poses[0].pose.position.y = through.poses[1].pose.position.y = 0.0;
  const GetClearanceResponse contact = ask(through);
  EXPECT_EQ(contact.status, GetClearanceResponse::PENETRATING);
  ASSERT_TRUE(contact.has_first_time);
  // From x = 6 to -4 in one second; it touches the tip at x = 3.
  EXPECT_NEAR(contact.first_time, 0.3, 1e-3);
}

TEST_F(ClearanceServiceTest, SaysWhatOfAMotionItHasNotUsed) {
  GetClearanceRequest request = approach();
  request.trajectory.points[0].velocities = {0.1, 0.0};
  EXPECT_NE(ask(request).message.find("velocities were not used, because a point has none"),
            std::string::npos);
  request.trajectory.points[1].velocities = {0.1, 0.0};
  EXPECT_EQ(ask(request).message.find("velocities"), std::string::npos);
  request.trajectory.points[1].time_from_start = ros::Duration(0.0);
  EXPECT_NE(ask(request).message.find("no point has a time"), std::string::npos);
  request = approach();
  request.trajectory.points[1].positions[0] = 500.0;
  EXPECT_NE(ask(request).message.find("leaves the range that the URDF gives to l_base_slide"),
            std::string::npos)
      << ask(request).message;
}

TEST_F(ClearanceServiceTest, RefusesTrajectoriesThatAreWrong) {
  GetClearanceRequest request;
  expectRefusal(request, "neither a trajectory nor poses");
  request = approach();
  request.body = "cart";
  expectRefusal(request, "a trajectory and a path of poses");
  request = approach();
  request.trajectory.points.clear();
  expectRefusal(request, "it has no points");
  request = approach();
  request.trajectory.joint_names[0] = "wing";
  expectRefusal(request, "joint 'wing': no robot of the scene has it");
  request = approach();
  request.trajectory.joint_names[0] = "l_slide_tip";
  expectRefusal(request, "'l_slide_tip': it is given twice");
  request = approach();
  request.trajectory.points[1].positions.pop_back();
  expectRefusal(request, "trajectory.points[1].positions: 1 number for 2 joints");
  request = approach();
  request.trajectory.points[1].velocities = {1.0};
  expectRefusal(request, "trajectory.points[1].velocities: 1 number for 2 joints");
  request = approach();
  request.trajectory.points[1].positions[0] = std::numeric_limits<double>::quiet_NaN();
  expectRefusal(request, "waypoint 1, joint 'l_base_slide': one of the positions is nan");
  request = approach();
  request.trajectory.points[0].time_from_start = ros::Duration(5.0);
  expectRefusal(request, "waypoint 1: its time, 4 s, is not after that of the waypoint before it, 5 s");
  request = approach();
  request.trajectory.points.resize(101, request.trajectory.points[1]);
  expectRefusal(request, "it has 101 waypoints");
}

TEST_F(ClearanceServiceTest, RefusesPathsThatAreWrong) {
  GetClearanceRequest request = path();
  request.body = "wagon";
  expectRefusal(request, "body 'wagon': the scene has no such body");
  request = path();
  request.poses.clear();
  expectRefusal(request, "poses: the list is empty");
  request = path();
  request.poses[0].header.frame_id = request.poses[1].header.frame_id = "moon";
  expectRefusal(request, "tf does not connect 'moon' with 'world'");
  request = path();
  request.poses[1].header.frame_id = "l_base";
  expectRefusal(request, "give all poses in one frame");
  request = path();
  request.poses[1].pose.orientation.w = 0.5;
  expectRefusal(request, "poses[1].orientation: the quaternion's norm is 0.5");
  request = path();
  request.poses[1].pose.position.x = std::numeric_limits<double>::infinity();
  expectRefusal(request, "poses[1].position");
}

TEST_F(ClearanceServiceTest, RefusesParametersThatAreWrong) {
  GetClearanceRequest request = approach();
  for (const double tolerance : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
    request.tolerance = tolerance;
    expectRefusal(request, "tolerance: the value is");
  }
  request = approach();
  request.with_first_time = true;
  request.threshold = -1.0;
  expectRefusal(request, "threshold: the value is -1");
  request = approach();
  request.time_budget = 31.0;
  expectRefusal(request, "~limits/clearance_seconds is 30");
  request = approach();
  request.joints.name = {"l_base_slide"};
  request.joints.position = {0.0};
  expectRefusal(request, "l_slide_tip missing");
}

// A tolerance that rounding does not allow keeps it busy until it is told to stop.
TEST_F(ClearanceServiceTest, ReportsProgressAndEndsWhenItIsCancelled) {
  Collector<ClearanceFeedback> feedback(kNode + "clearance_progress");
  Collector<Distances> distances(kNode + "distances");
  GetClearanceRequest request = path();
  request.id = "long";
  request.tolerance = 1e-13;
  request.each_pair = true;
  GetClearanceResponse response;
  std::thread caller([&] { response = ask(request); });
  const auto running =
      feedback.match([](const ClearanceFeedback& each) { return each.id == "long" && each.is_done == 0; });
  EXPECT_TRUE(running.has_value());
  expectRefusal(request, "a request 'long' is running");
  distances.clear();
  EXPECT_TRUE(distances.match([](const Distances&) { return true; }).has_value()) << "the cycle goes on";
  CancelClearanceRequest cancel;
  cancel.id = "long";
  EXPECT_TRUE(call<CancelClearance>(kNode + "cancel_clearance", cancel).success);
  caller.join();
  EXPECT_TRUE(response.success) << response.message;
  EXPECT_EQ(response.status, GetClearanceResponse::BUDGET_EXHAUSTED);
  EXPECT_LE(response.lower_bound, 0.25);
  EXPECT_GE(response.distance, 0.25 - kRounding);
  EXPECT_TRUE(feedback.match([](const ClearanceFeedback& each) { return each.is_done != 0; }).has_value());
  EXPECT_FALSE(call<CancelClearance>(kNode + "cancel_clearance", cancel).success) << "it has ended";
}

// The last test: the right robot leaves.
TEST_F(ClearanceServiceTest, ZRefusesJointsOfARobotThatHasLeft) {
  for (const std::string link : {"r_base", "r_tip"}) {
    RemoveBodyRequest removal;
    removal.name = link;
    removal.allow_robot_link = 1;
    ASSERT_TRUE(call<RemoveBody>(kNode + "remove_body", removal).success);
  }
  GetClearanceRequest request = approach();
  request.trajectory.joint_names = {"r_base_slide", "r_slide_tip"};
  expectRefusal(request, "its robot 'r_");
}

}  // namespace
}  // namespace concave_distance::clearance_rostest
