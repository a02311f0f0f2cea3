// Long queries hold up nothing else: not the other services, not subscribers, not the end of the node; and
// what goes beyond a limit is refused with the figure.
#include <concave_distance/AddBody.h>
#include <concave_distance/Distances.h>
#include <concave_distance/GetDistance.h>
#include <concave_distance/GetDistances.h>
#include <concave_distance/ListBodies.h>
#include <gtest/gtest.h>
#include <ros/package.h>
#include <std_msgs/Float64.h>

#include <cmath>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "ros/topics/watched_topic.h"
#include "rostest_support.h"
#include "started_node.h"
#include "support/count_allocations.h"
#include "tf_player.h"

namespace concave_distance::limits_rostest {
namespace {

// Bytes that a topic may leave behind; what roscpp's node handle keeps of a publisher is 272.
constexpr double kLeftOfATopic = 64.0;

constexpr const char* kLimited = "/limited/";
constexpr double kManyTimesLonger = 30.0;  // s, than an end takes; far less than the queries would

std::vector<std::string> limitedNode(const std::string& query_seconds = "600.0") {
  const std::string scene =
      ros::package::getPath("concave_distance") + "/test/ros/rostest/hook_and_comb.yaml";
  return {"__name:=limited",
          "_scene_file:=" + scene,
          "_limits/service_threads:=1",
          "_limits/service_queue:=0",
          "_limits/query_seconds:=" + query_seconds,
          "_limits/largest_query_count:=20000",
          "_limits/largest_body_count:=4"};
}

DistanceQuery coldQuery(int index) {
  DistanceQuery query;
  query.body_a = "hook";
  query.body_b = "comb";
  query.with_niches = 1;
  query.use_pose_a = query.use_pose_b = 1;
  query.pose_a.pose.orientation.w = query.pose_b.pose.orientation.w = 1.0;
  query.pose_a.pose.position.z = 0.6 + 1e-5 * index;
  return query;
}

// Minutes of work for any machine.
GetDistances longCall() {
  GetDistances service;
  for (int index = 0; index < 20000; ++index) {
    service.request.queries.push_back(coldQuery(index));
  }
  return service;
}

class LimitsTest : public ::testing::Test {
 protected:
  LimitsTest() : node(std::make_unique<StartedNode>(limitedNode())) {
    player.place("hook", 0.0, 0.0);
    EXPECT_TRUE(
        eventually([] { return call<ListBodies>(std::string(kLimited) + "list_bodies", {}).ready != 0; }));
  }
  ~LimitsTest() override {
    node.reset();
    if (long_call.valid()) {
      long_call.wait();
    }
  }
  static GetDistance::Response askOne() {
    GetDistance::Request request;
    request.query = coldQuery(0);
    return call<GetDistance>(std::string(kLimited) + "get_distance", request);
  }
  static bool isBusy() { return askOne().message.find("SERVICE BUSY") != std::string::npos; }
  void startLongCall() {
    long_call = std::async(std::launch::async, [] {
      GetDistances service = longCall();
      bool answered = false;
      do {  // a look whether the node is busy may have the only thread
        answered = ros::service::call(std::string(kLimited) + "get_distances", service);
      } while (answered && service.response.message.find("SERVICE BUSY") != std::string::npos);
      return answered;
    });
    ASSERT_TRUE(eventually(isBusy)) << "the long call has the only thread";
  }

  TfPlayer player;
  std::unique_ptr<StartedNode> node;
  std::future<bool> long_call;
};

TEST_F(LimitsTest, ALongQueryHoldsUpNoOtherServiceAndNoSubscriber) {
  startLongCall();
  EXPECT_TRUE(call<ListBodies>(std::string(kLimited) + "list_bodies", {}).ready);
  Collector<Distances> distances(std::string(kLimited) + "distances");
  EXPECT_TRUE(eventually([&] { return distances.count() > 20; }));
  EXPECT_TRUE(isBusy()) << "it still runs";
}

TEST_F(LimitsTest, ALongQueryDoesNotHoldUpTheEndOfTheNode) {
  startLongCall();
  node->interrupt();
  EXPECT_EQ(node->waitForEnd(kManyTimesLonger), 0) << "the node runs on after Ctrl-C";
}

TEST_F(LimitsTest, WhatIsBeyondALimitIsRefusedWithTheFigure) {
  GetDistances::Request many;
  many.queries.resize(20001);
  const auto refused = call<GetDistances>(std::string(kLimited) + "get_distances", many);
  EXPECT_FALSE(refused.success);
  EXPECT_NE(refused.message.find("20001 in one call"), std::string::npos) << refused.message;
  EXPECT_NE(refused.message.find("~limits/largest_query_count is 20000"), std::string::npos)
      << refused.message;
  AddBodyRequest body;
  body.name = "first";
  body.frame_id = "world";
  body.pose.orientation.w = 1.0;
  body.primitive = "box";
  body.dimensions = {1.0, 1.0, 1.0};
  body.without_pairs = 1;
  body.max_edge_length = 0.002;
  const auto fine = call<AddBody>(std::string(kLimited) + "add_body", body);
  EXPECT_FALSE(fine.success);
  EXPECT_NE(fine.message.find("the limit is 200000 nodes"), std::string::npos) << fine.message;
  body.max_edge_length = 0.0;
  const auto added = call<AddBody>(std::string(kLimited) + "add_body", body);
  EXPECT_TRUE(added.success) << added.message;
  EXPECT_TRUE(added.pairs.empty());
  body.name = "second";
  const auto fifth = call<AddBody>(std::string(kLimited) + "add_body", body);
  EXPECT_FALSE(fifth.success);
  EXPECT_NE(fifth.message.find("4 bodies, the limit"), std::string::npos) << fifth.message;
}

TEST(TimeLimit, OfACallHoldsForAllItsQueriesTogether) {
  const StartedNode node(limitedNode("0.5"));
  ASSERT_TRUE(
      eventually([] { return call<ListBodies>(std::string(kLimited) + "list_bodies", {}).ready != 0; }));
  GetDistances service = longCall();
  ASSERT_TRUE(ros::service::call(std::string(kLimited) + "get_distances", service));
  ASSERT_EQ(service.response.results.size(), service.request.queries.size());
  EXPECT_TRUE(service.response.results.front().nearest.has_distance);
  const PairDistance& last = service.response.results.back().nearest;
  EXPECT_FALSE(last.has_distance);
  EXPECT_TRUE(std::isnan(last.distance));
  EXPECT_EQ(last.status.code, PairStatus::BUDGET_EXHAUSTED);
  EXPECT_NE(last.status.message.find("~limits/query_seconds"), std::string::npos) << last.status.message;
  EXPECT_FALSE(service.response.success);
}

// A scene that is edited for months advertises and drops topics without end.
TEST(Limits, TopicsThatAreDroppedLeaveNoMemoryBehind) {
  const ros::NodeHandle node("~");
  const auto come_and_go = [&](int count) {
    for (int k = 0; k < count; ++k) WatchedTopic::advertise<std_msgs::Float64>(node, "fleeting", 1);
  };
  come_and_go(200);
  constexpr int kTopics = 2000;
  const auto before = static_cast<double>(allocated_bytes);
  come_and_go(kTopics);
  EXPECT_LT(static_cast<double>(allocated_bytes) - before, kLeftOfATopic * kTopics);
}

}  // namespace
}  // namespace concave_distance::limits_rostest
