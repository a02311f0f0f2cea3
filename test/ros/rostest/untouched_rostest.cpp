// Services leave what is tracked alone, to the last bit: two nodes follow the same motion, one of them is
// asked all the time, and every message of the one is that of the other.
#include <concave_distance/AddBody.h>
#include <concave_distance/GetDistance.h>
#include <concave_distance/GetDistances.h>
#include <concave_distance/ListBodies.h>
#include <concave_distance/PairNiches.h>
#include <concave_distance/RemoveBody.h>
#include <concave_distance/SetPairEnabled.h>
#include <gtest/gtest.h>
#include <ros/serialization.h>
#include <tf2_msgs/TFMessage.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "rostest_support.h"

namespace concave_distance::untouched_rostest {
namespace {

constexpr int kSteps = 60;

// The hook sways over the comb; all poses of one step have one stamp.
geometry_msgs::TransformStamped hookAt(int step, ros::Time stamp) {
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = stamp;
  transform.header.frame_id = "world";
  transform.child_frame_id = "hook";
  transform.transform.translation.x = 0.1 * std::sin(0.1 * step);
  transform.transform.translation.z = 0.62 + 0.03 * std::sin(0.17 * step);
  transform.transform.rotation.z = std::sin(0.05 * std::sin(0.13 * step));
  transform.transform.rotation.w = std::cos(0.05 * std::sin(0.13 * step));
  return transform;
}

// Everything that the tracking determines: all but the time it took and the sender's count.
std::vector<std::uint8_t> tracked(PairNiches message) {
  message.solve_time = message.nearest.cost.solve_time = 0.0;
  message.header.seq = message.nearest.header.seq = 0;
  std::vector<std::uint8_t> bytes(ros::serialization::serializationLength(message));
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, message);
  return bytes;
}

// Queries of the watched pair at other poses, of other pairs and bad ones; a body that comes and goes; a pair
// switched.
void ask(const std::string& node, int step) {
  GetDistancesRequest queries;
  queries.queries.resize(3);
  for (DistanceQuery& query : queries.queries) {
    query.body_a = "hook";
    query.body_b = "comb";
    query.with_niches = 1;
    query.use_pose_a = 1;
    query.pose_a.pose.orientation.w = 1.0;
    query.pose_a.pose.position.z = 0.4 + 0.01 * step;
  }
  queries.queries[1].body_a = "comb";
  queries.queries[1].body_b = "hook";
  queries.queries[1].use_pose_a = 0;
  queries.queries[2].accuracy = DistanceQuery::ACCURACY_NODES;
  const auto answers = call<GetDistances>(node + "/get_distances", queries);
  EXPECT_TRUE(answers.success) << answers.message;
  GetDistanceRequest bad;
  bad.query = queries.queries[0];
  bad.query.pose_a.pose.orientation.w = 0.5;
  EXPECT_FALSE(call<GetDistance>(node + "/get_distance", bad).success);
  call<ListBodies>(node + "/list_bodies", {});
  if (step % 10 == 0) {
    AddBodyRequest body;
    body.name = "cup";
    body.frame_id = "world";
    body.pose.orientation.w = 1.0;
    body.primitive = "box";
    body.dimensions = {0.1, 0.1, 0.1};
    EXPECT_TRUE(call<AddBody>(node + "/add_body", body).success);
    SetPairEnabledRequest pair;
    pair.body_a = "hook";
    pair.body_b = "box_a";
    EXPECT_TRUE(call<SetPairEnabled>(node + "/set_pair_enabled", pair).success);
    RemoveBodyRequest removal;
    removal.name = "cup";
    EXPECT_TRUE(call<RemoveBody>(node + "/remove_body", removal).success);
  }
}

// A node makes what niches need in the background, the grids last: nodes are added until that is done.
bool isPrepared(const std::string& node) {
  constexpr int kTimesTheSame = 20;
  std::uint64_t last = 0;
  int times = 0;
  return eventually([&] {
    std::uint64_t nodes = 0;
    for (const BodyInfo& body : call<ListBodies>(node + "/list_bodies", {}).bodies) nodes += body.grid_nodes;
    times = nodes > 0 && nodes == last ? times + 1 : 0;
    last = nodes;
    ros::WallDuration(0.02).sleep();
    return times == kTimesTheSame;
  });
}

TEST(Services, LeaveWhatIsTrackedUntouchedToTheLastBit) {
  for (const char* node : {"/asked", "/left_alone"}) {
    ASSERT_TRUE(
        eventually([&] { return call<ListBodies>(std::string(node) + "/list_bodies", {}).ready != 0; }));
    ASSERT_TRUE(isPrepared(node));
  }
  Collector<PairNiches> asked("/asked/pairs/watched/niches");
  Collector<PairNiches> left_alone("/left_alone/pairs/watched/niches");
  ASSERT_TRUE(eventually([&] { return asked.count() > 0 && left_alone.count() > 0; }));
  ros::NodeHandle node;
  ros::Publisher transforms = node.advertise<tf2_msgs::TFMessage>("/tf", 10);
  ASSERT_TRUE(eventually([&] { return transforms.getNumSubscribers() == 2; }));
  std::size_t niches = 0;
  std::size_t changes = 0;
  ros::Time stamp = ros::Time::now();
  for (int step = 0; step < kSteps; ++step) {
    // Both nodes solve each stamp once: the next one is sent when both have answered.
    stamp += ros::Duration(0.02);
    tf2_msgs::TFMessage message;
    message.transforms.push_back(hookAt(step, stamp));
    transforms.publish(message);
    const auto is_of_this_step = [&](const PairNiches& message) {
      return message.header.stamp == stamp && message.nearest.has_distance != 0;
    };
    ASSERT_TRUE(asked.waitFor(is_of_this_step)) << step;
    ASSERT_TRUE(left_alone.waitFor(is_of_this_step)) << step;
    ASSERT_EQ(tracked(*asked.last()), tracked(*left_alone.last()))
        << "step " << step << ": cycle " << asked.last()->cycle << " and " << left_alone.last()->cycle
        << ", evaluations " << asked.last()->evaluations << " and " << left_alone.last()->evaluations;
    niches += asked.last()->niches.size();
    changes += asked.last()->changes.size();
    ask("/asked", step);
  }
  EXPECT_EQ(asked.last()->cycle, static_cast<std::uint64_t>(kSteps - 1));
  EXPECT_TRUE(asked.last()->warm);
  EXPECT_GT(niches, static_cast<std::size_t>(kSteps)) << "there was something to be disturbed";
  EXPECT_GT(changes, 2U) << "niches came and went";
}

}  // namespace
}  // namespace concave_distance::untouched_rostest
