// Rows of constraints of a running node, and distances at joint positions, good requests and bad.
#include <concave_distance/Constraints.h>
#include <concave_distance/GetDistance.h>
#include <concave_distance/GetDistances.h>
#include <concave_distance/RemoveBody.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "node_access.h"
#include "tf_player.h"

namespace concave_distance::constraints_rostest {
namespace {

std::vector<std::size_t> slotsOf(const Constraints& message, const std::string& body_a,
                                 const std::string& body_b) {
  std::vector<std::size_t> slots;
  for (std::size_t i = 0; i < message.rows.size(); ++i) {
    const Constraint& row = message.rows[i];
    const bool is_it =
        (row.body_a == body_a && row.body_b == body_b) || (row.body_a == body_b && row.body_b == body_a);
    if (row.state == Constraint::USED && is_it) slots.push_back(i);
  }
  return slots;
}

class ConstraintsTest : public ::testing::Test {
 protected:
  ConstraintsTest() {
    for (const std::string prefix : {"l_", "r_"}) {
      const double y = prefix == "l_" ? 0.0 : 10.0;
      player.place(prefix + "base", 0.0, y);
      player.place(prefix + "slide", 1.0, y);
      player.place(prefix + "tip", 2.0, y);
    }
    player.place("cart", 6.0);
    EXPECT_TRUE(eventually([] {
      const GetDistanceResponse response = ask(queryAt(0.0, 0.0));
      return response.success && std::abs(response.result.nearest.distance - 5.0) < kRounding;
    }));
  }

  static DistanceQuery queryAt(double base_slide, double slide_tip) {
    DistanceQuery query;
    query.body_a = "l_tip";
    query.body_b = "cart";
    query.joints.name = {"l_base_slide", "l_slide_tip"};
    query.joints.position = {base_slide, slide_tip};
    return query;
  }
  static GetDistanceResponse ask(const DistanceQuery& query) {
    GetDistanceRequest request;
    request.query = query;
    return call<GetDistance>(kNode + "get_distance", request);
  }
  static void expectRefusal(const DistanceQuery& query, const std::string& part) {
    const GetDistanceResponse response = ask(query);
    EXPECT_FALSE(response.success);
    EXPECT_EQ(response.result.nearest.status.code, PairStatus::INVALID_REQUEST);
    EXPECT_NE(response.message.find(part), std::string::npos) << response.message;
    EXPECT_TRUE(std::isnan(response.result.nearest.distance));
  }

  TfPlayer player;
};

TEST_F(ConstraintsTest, HaveARowForEachCornerWithTheJointsOfAllRobots) {
  Collector<Constraints> constraints(kNode + "constraints");
  const auto message = constraints.match([](const Constraints& each) {
    return slotsOf(each, "l_tip", "cart").size() == 4 && slotsOf(each, "r_tip", "post").size() == 4;
  });
  ASSERT_TRUE(message.has_value());
  EXPECT_EQ(message->joints,
            (std::vector<std::string>{"l_base_slide", "l_slide_tip", "r_base_slide", "r_slide_tip"}));
  EXPECT_EQ(message->header.frame_id, "world");
  EXPECT_EQ(message->rows.size(), 20U);
  EXPECT_EQ(message->constraint_distance, 3.5);
  EXPECT_TRUE(message->problems.empty());
  for (const std::size_t slot : slotsOf(*message, "l_tip", "cart")) {
    const Constraint& row = message->rows[slot];
    EXPECT_NEAR(row.value, 3.0, kRounding);
    EXPECT_NEAR(row.lower_bound, 3.0, kRounding);
    ASSERT_EQ(row.jacobian.size(), 4U);
    const std::vector<double> expected{-1.0, -1.0, 0.0, 0.0};
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(row.jacobian[i], expected[i], kRounding);
    const bool tip_is_a = row.body_a == "l_tip";
    EXPECT_EQ(tip_is_a ? row.frame_a : row.frame_b, "l_tip");
    EXPECT_NEAR((tip_is_a ? row.point_a_in_frame_a : row.point_b_in_frame_b).x, 0.5, kRounding);
    EXPECT_NEAR((tip_is_a ? row.point_a : row.point_b).x, 2.5, kRounding);
    EXPECT_NEAR(row.normal.x, tip_is_a ? 1.0 : -1.0, kRounding);
  }
  for (const std::size_t slot : slotsOf(*message, "r_tip", "post")) {
    EXPECT_NEAR(message->rows[slot].jacobian[2], -1.0, kRounding);
    EXPECT_NEAR(message->rows[slot].jacobian[0], 0.0, kRounding);
  }
}

TEST_F(ConstraintsTest, KeepTheirSlotsAndKnowWhatComesByItself) {
  Collector<Constraints> constraints(kNode + "constraints");
  ASSERT_TRUE(constraints.match(
      [](const Constraints& message) { return slotsOf(message, "l_tip", "cart").size() == 4; }));
  constraints.clear();
  player.glide("cart", 6.0, 4.0, 2.0);
  ASSERT_TRUE(constraints.match([](const Constraints& message) {
    const auto slots = slotsOf(message, "l_tip", "cart");
    return !slots.empty() && std::abs(message.rows[slots.front()].value - 1.0) < 1e-9;
  }));
  std::optional<std::vector<std::size_t>> slots;
  std::uint64_t age = 0;
  bool has_drift = false;
  for (const Constraints& message : constraints.all()) {
    const auto now = slotsOf(message, "l_tip", "cart");
    ASSERT_EQ(now.size(), 4U);
    if (slots) {
      ASSERT_EQ(now, *slots) << "a row has moved";
    }
    slots = now;
    const Constraint& row = message.rows[now.front()];
    EXPECT_GE(row.age, age);
    age = row.age;
    // Poses lag behind the cycles' clock by less than their period, so that only a mean of drifts is smooth.
    has_drift = has_drift || (row.has_drift != 0 && row.drift > 0.5 && row.drift < 2.0);
  }
  EXPECT_TRUE(has_drift) << "1 m/s";
}

TEST_F(ConstraintsTest, SayWhichLinkIsNotOnTf) {
  player.drop("r_slide");
  Collector<Constraints> constraints(kNode + "constraints");
  const auto message = constraints.match([](const Constraints& each) {
    return slotsOf(each, "r_tip", "post").empty() && slotsOf(each, "l_tip", "cart").size() == 4;
  });
  ASSERT_TRUE(message.has_value());
  ASSERT_EQ(message->problems.size(), 1U);
  EXPECT_EQ(message->problems[0].rfind("robot 'r_two_links': no pose of link 'r_slide': ", 0), 0U)
      << message->problems[0];
}

TEST_F(ConstraintsTest, GetDistanceTakesJointPositions) {
  for (const double at : {0.0, 0.75, 1.5}) {
    const GetDistanceResponse response = ask(queryAt(at, 2.0 * at));
    ASSERT_TRUE(response.success) << response.message;
    EXPECT_NEAR(response.result.nearest.distance, std::max(0.0, 5.0 - 3.0 * at), kRounding);
  }
  player.place("l_base", 0.0, 0.0, 2.0);
  EXPECT_TRUE(eventually([] {
    const GetDistanceResponse response = ask(queryAt(3.0, 3.0));
    return response.success && std::abs(response.result.nearest.distance - 1.0) < kRounding;
  })) << "the root link is where tf has it: 2 m above the cart";
}

TEST_F(ConstraintsTest, GetDistancesTakesThousandsOfJointPositions) {
  GetDistancesRequest request;
  for (int i = 0; i < 3000; ++i) request.queries.push_back(queryAt(0.001 * i, 0.0005 * i));
  request.queries[7].joints.name[0] = "l_base_slid";
  request.queries[8].joints.position[1] = std::nan("");
  const auto response = call<GetDistances>(kNode + "get_distances", request);
  EXPECT_FALSE(response.success);
  EXPECT_NE(response.message.find("2 of 3000 queries have no distance"), std::string::npos)
      << response.message;
  ASSERT_EQ(response.results.size(), 3000U);
  for (int i = 0; i < 3000; ++i) {
    const PairDistance& nearest = response.results[static_cast<std::size_t>(i)].nearest;
    if (i == 7 || i == 8) {
      EXPECT_EQ(nearest.status.code, PairStatus::INVALID_REQUEST);
      continue;
    }
    ASSERT_NEAR(nearest.distance, 5.0 - 0.0015 * i, kRounding) << i << " " << nearest.status.message;
  }
}

TEST_F(ConstraintsTest, GetDistanceRefusesJointPositionsThatAreNotTheRobots) {
  DistanceQuery query = queryAt(0.0, 0.0);
  query.joints.name[1] = "slide_tip";
  expectRefusal(query,
                "joint 'slide_tip': no robot of the scene has it (the scene's joints are l_base_slide");
  query = queryAt(0.0, 0.0);
  query.joints.name.pop_back();
  query.joints.position.pop_back();
  expectRefusal(query, "robot 'l_two_links': l_slide_tip missing");
  query = queryAt(0.0, 0.0);
  query.joints.position.push_back(1.0);
  expectRefusal(query, "2 names and 3 positions");
  query = queryAt(0.0, 0.0);
  query.joints.name.push_back("l_slide_tip");
  query.joints.position.push_back(1.0);
  expectRefusal(query, "joint 'l_slide_tip': it is given twice");
  query = queryAt(0.0, std::numeric_limits<double>::infinity());
  expectRefusal(query, "joint 'l_slide_tip': its position is not finite");
  query = queryAt(0.0, 0.0);
  query.joints.name = {"r_base_slide", "r_slide_tip"};
  expectRefusal(query, "neither 'l_tip' nor 'cart' is on a robot that they name");
}

// The last test: the robot does not come back.
TEST_F(ConstraintsTest, KnowARobotThatHasLeft) {
  Collector<Constraints> constraints(kNode + "constraints");
  ASSERT_TRUE(constraints.match(
      [](const Constraints& message) { return slotsOf(message, "l_tip", "cart").size() == 4; }));
  const auto before = slotsOf(*constraints.last(), "l_tip", "cart");
  for (const std::string body : {"r_base", "r_tip"}) {
    RemoveBodyRequest request;
    request.name = body;
    request.allow_robot_link = 1;
    const auto response = call<RemoveBody>(kNode + "remove_body", request);
    ASSERT_TRUE(response.success) << response.message;
  }
  const auto message = constraints.match([](const Constraints& each) { return each.joints.size() == 2; });
  ASSERT_TRUE(message.has_value());
  EXPECT_TRUE(slotsOf(*message, "r_tip", "post").empty());
  EXPECT_EQ(slotsOf(*message, "l_tip", "cart"), before) << "the other robot's rows stay";
  DistanceQuery query = queryAt(0.0, 0.0);
  query.joints.name.push_back("r_slide_tip");
  query.joints.position.push_back(0.0);
  expectRefusal(query, "joint 'r_slide_tip': its robot 'r_two_links' has no body in the scene any more");
}

}  // namespace
}  // namespace concave_distance::constraints_rostest
