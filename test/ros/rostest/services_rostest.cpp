// Services of a running node, good requests and bad, and that they leave the tracking alone.
#include <concave_distance/AddBody.h>
#include <concave_distance/GetDistance.h>
#include <concave_distance/GetDistances.h>
#include <concave_distance/ListBodies.h>
#include <concave_distance/Niches.h>
#include <concave_distance/PairNiches.h>
#include <concave_distance/RemoveBody.h>
#include <concave_distance/ResetTracking.h>
#include <concave_distance/SetPairEnabled.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "node_access.h"
#include "tf_player.h"

namespace concave_distance::services_rostest {
namespace {

GetDistanceRequest boxes() {
  GetDistanceRequest request;
  request.query.body_a = "box_a";
  request.query.body_b = "box_b";
  request.query.pose_a.pose.orientation.w = request.query.pose_b.pose.orientation.w = 1.0;
  return request;
}

void expectRefusal(const GetDistanceRequest& request, const std::string& part) {
  const auto response = call<GetDistance>(kNode + "get_distance", request);
  EXPECT_FALSE(response.success);
  EXPECT_NE(response.message.find(part), std::string::npos) << response.message;
  EXPECT_TRUE(std::isnan(response.result.nearest.distance));
  EXPECT_FALSE(response.result.nearest.has_distance);
}

class ServicesTest : public ::testing::Test {
 protected:
  ServicesTest() {
    player.place("box_a", 0.0);
    player.place("box_b", 2.0);
    player.place("ball", 0.0, 3.0);
    EXPECT_TRUE(eventually([] {
      const ListBodiesResponse list = call<ListBodies>(kNode + "list_bodies", {});
      return list.ready && call<GetDistance>(kNode + "get_distance", boxes()).success;
    }));
  }
  TfPlayer player;
};

TEST_F(ServicesTest, ListBodiesTellsBodiesPairsAndTheFrame) {
  const auto list = call<ListBodies>(kNode + "list_bodies", {});
  EXPECT_TRUE(list.ready);
  EXPECT_EQ(list.reference_frame, "world");
  ASSERT_EQ(list.bodies.size(), 4U);
  EXPECT_EQ(list.bodies[0].name, "box_a");
  EXPECT_EQ(list.bodies[0].triangles, 12U);
  EXPECT_TRUE(list.bodies[0].closed);
  ASSERT_EQ(list.pairs.size(), 3U);
  EXPECT_EQ(list.pairs[0].name, "boxes");
  EXPECT_EQ(list.pairs[0].warning_distance, 0.5);
  EXPECT_FALSE(list.pairs[1].has_warning_distance);
  EXPECT_TRUE(list.problems.empty());
}

TEST_F(ServicesTest, GetDistanceAnswersInTheReferenceFrame) {
  const auto response = call<GetDistance>(kNode + "get_distance", boxes());
  ASSERT_TRUE(response.success) << response.message;
  EXPECT_NEAR(response.result.nearest.distance, 1.0, kRounding);
  EXPECT_EQ(response.result.header.frame_id, "world");
  EXPECT_FALSE(response.result.header.stamp.isZero());
  EXPECT_TRUE(response.result.niches.empty());
}

TEST_F(ServicesTest, GetDistanceTakesPosesAndTellsNiches) {
  GetDistanceRequest request = boxes();
  request.query.use_pose_b = 1;
  request.query.pose_b.header.frame_id = "box_a";
  request.query.pose_b.pose.position.z = 1.25;
  request.query.with_niches = 1;
  request.query.accuracy = DistanceQuery::ACCURACY_NODES;
  const auto response = call<GetDistance>(kNode + "get_distance", request);
  ASSERT_TRUE(response.success) << response.message;
  EXPECT_NEAR(response.result.nearest.distance, 0.25, kRounding) << "nodes lie over nodes";
  EXPECT_EQ(response.result.nearest.accuracy, PairDistance::ACCURACY_NODES);
  EXPECT_FALSE(response.result.niches.empty());
}

TEST_F(ServicesTest, GetDistanceWaitsForAStampAndRefusesOneThatNeverComes) {
  GetDistanceRequest request = boxes();
  request.query.stamp = ros::Time::now() + ros::Duration(0.1);
  EXPECT_TRUE(call<GetDistance>(kNode + "get_distance", request).success) << "it comes in 0.1 s";
  request.query.stamp = ros::Time::now() + ros::Duration(100.0);
  expectRefusal(request, "extrapolation");
}

TEST_F(ServicesTest, GetDistanceRefusesBadRequestsWithTheReason) {
  GetDistanceRequest request = boxes();
  request.query.body_b = "nobody";
  expectRefusal(request, "nobody");
  expectRefusal(request, "list_bodies has");
  request = boxes();
  request.query.body_b = "box_a";
  expectRefusal(request, "two different bodies");
  request = boxes();
  request.query.use_pose_a = 1;
  request.query.pose_a.header.frame_id = "atlantis";
  expectRefusal(request, "atlantis");
  request.query.pose_a.header.frame_id = "";
  request.query.pose_a.pose.orientation.w = 0.9;
  expectRefusal(request, "quaternion");
  request.query.pose_a.pose.orientation.w = 1.0;
  request.query.pose_a.pose.position.y = std::numeric_limits<double>::quiet_NaN();
  expectRefusal(request, "finite");
  request.query.pose_a.pose.position.y = 0.0;
  request.query.pose_a.pose.orientation.x = std::numeric_limits<double>::quiet_NaN();
  expectRefusal(request, "finite");
  request.query.pose_a.pose.orientation.x = 0.0;
  request.query.pose_a.pose.orientation.w = 0.5;
  expectRefusal(request, "quaternion");
  request = boxes();
  request.query.accuracy = 5;
  expectRefusal(request, "accuracy");
  request = boxes();
  request.query.accuracy = DistanceQuery::ACCURACY_REFINED;
  request.query.relative_tolerance = 0.01;
  expectRefusal(request, "relative_tolerance");
  EXPECT_TRUE(call<GetDistance>(kNode + "get_distance", boxes()).success) << "the node is alive";
}

TEST_F(ServicesTest, GetDistancesAnswersEachQueryOnItsOwn) {
  GetDistancesRequest request;
  const auto empty = call<GetDistances>(kNode + "get_distances", request);
  EXPECT_FALSE(empty.success);
  EXPECT_NE(empty.message.find("empty"), std::string::npos) << empty.message;
  request.queries = {boxes().query, boxes().query, boxes().query};
  request.queries[1].body_a = "nobody";
  request.queries[2].body_b = "ball";
  const auto response = call<GetDistances>(kNode + "get_distances", request);
  EXPECT_FALSE(response.success);
  EXPECT_NE(response.message.find("1 of 3"), std::string::npos) << response.message;
  ASSERT_EQ(response.results.size(), 3U);
  EXPECT_NEAR(response.results[0].nearest.distance, 1.0, kRounding);
  EXPECT_EQ(response.results[1].nearest.status.code, PairStatus::INVALID_REQUEST);
  // The ball is inscribed with a chord error of 0.01: never nearer than the true 2.0, nor 0.01 farther.
  EXPECT_GE(response.results[2].nearest.distance, 2.0 - kRounding);
  EXPECT_LE(response.results[2].nearest.distance, 2.01);
}

TEST_F(ServicesTest, QueriesWhileTrackingTouchNoNiche) {
  Collector<PairNiches> tracked(kNode + "pairs/boxes/niches");
  ASSERT_TRUE(
      tracked.waitFor([](const PairNiches& niches) { return niches.warm && !niches.niches.empty(); }));
  const PairNiches before = *tracked.last();
  GetDistancesRequest request;
  request.queries.assign(10, boxes().query);
  for (DistanceQuery& query : request.queries) {
    query.with_niches = 1;
    query.use_pose_b = 1;
    query.pose_b.pose.position.x = -3.0;
  }
  EXPECT_TRUE(call<GetDistances>(kNode + "get_distances", request).success);
  ASSERT_TRUE(tracked.waitFor([&](const PairNiches& niches) { return niches.cycle > before.cycle + 5; }));
  std::set<std::uint64_t> ids;
  for (const Niche& niche : before.niches) {
    ids.insert(niche.id);
  }
  std::uint64_t cycle = before.cycle;
  for (const PairNiches& niches : tracked.all()) {
    if (niches.cycle <= before.cycle) {
      continue;
    }
    EXPECT_LE(niches.cycle, cycle + 1) << "no cycle is counted that was not published";
    cycle = niches.cycle;
    EXPECT_TRUE(niches.warm);
    EXPECT_EQ(niches.nearest.nearest_niche_id, before.nearest.nearest_niche_id);
    EXPECT_NEAR(niches.nearest.distance, 1.0, kRounding);
  }
}

TEST_F(ServicesTest, ResetTrackingStartsColdWithFreshIds) {
  Collector<PairNiches> tracked(kNode + "pairs/boxes/niches");
  ASSERT_TRUE(
      tracked.waitFor([](const PairNiches& niches) { return niches.warm && !niches.niches.empty(); }));
  const std::uint64_t id = tracked.last()->nearest.nearest_niche_id;
  ResetTrackingRequest request;
  request.pair = "boxes";
  const auto response = call<ResetTracking>(kNode + "reset_tracking", request);
  EXPECT_TRUE(response.success);
  EXPECT_EQ(response.count, 1U);
  EXPECT_TRUE(
      tracked.waitFor([&](const PairNiches& niches) { return niches.nearest.nearest_niche_id > id; }));
  const std::vector<PairNiches> all = tracked.all();
  EXPECT_TRUE(std::any_of(all.begin() + 1, all.end(), [](const PairNiches& niches) { return !niches.warm; }));
  request.pair = "nobody";
  EXPECT_FALSE(call<ResetTracking>(kNode + "reset_tracking", request).success);
  request.pair = "";
  EXPECT_EQ(call<ResetTracking>(kNode + "reset_tracking", request).count, 3U);
}

TEST_F(ServicesTest, SetPairEnabledTakesAPairOutAndBack) {
  Collector<Niches> all(kNode + "niches");
  const auto sees = [](std::size_t count) {
    return [count](const Niches& niches) { return niches.pairs.size() == count; };
  };
  ASSERT_TRUE(all.waitFor(sees(2))) << "the third is beyond its cutoff";
  SetPairEnabledRequest request;
  request.pair = "box_ball";
  EXPECT_TRUE(call<SetPairEnabled>(kNode + "set_pair_enabled", request).success);
  EXPECT_TRUE(all.waitFor(sees(1)));
  request.pair = "";
  request.body_a = "ball";
  request.body_b = "box_a";
  request.enabled = 1;
  EXPECT_EQ(call<SetPairEnabled>(kNode + "set_pair_enabled", request).pair, "box_ball");
  EXPECT_TRUE(all.waitFor(sees(2)));
  request.body_b = "nobody";
  const auto refused = call<SetPairEnabled>(kNode + "set_pair_enabled", request);
  EXPECT_FALSE(refused.success);
  EXPECT_NE(refused.message.find("nobody"), std::string::npos) << refused.message;
}

TEST_F(ServicesTest, AddedBodiesAreWatchedAndRemovedOnesNot) {
  AddBodyRequest request;
  request.name = "cup";
  request.frame_id = "box_b";
  request.pose.orientation.w = 1.0;
  request.pose.position.z = 2.0;
  request.primitive = "box";
  request.dimensions = {1.0, 1.0, 1.0};
  const auto added = call<AddBody>(kNode + "add_body", request);
  ASSERT_TRUE(added.success) << added.message;
  EXPECT_EQ(added.pairs.size(), 3U) << "not with box_b, which it is fixed to";
  EXPECT_FALSE(call<AddBody>(kNode + "add_body", request).success) << "the name is taken";
  {
    Collector<PairDistance> distance(kNode + "pairs/cup/box_a/distance");
    const auto solved = distance.match([](const PairDistance& message) { return message.has_distance != 0; });
    ASSERT_TRUE(solved);
    EXPECT_NEAR(solved->distance, std::hypot(1.0, 1.0), kRounding);
  }
  RemoveBodyRequest removal;
  removal.name = "cup";
  EXPECT_EQ(call<RemoveBody>(kNode + "remove_body", removal).pairs.size(), 3U);
  EXPECT_FALSE(call<RemoveBody>(kNode + "remove_body", removal).success);
  EXPECT_EQ(call<ListBodies>(kNode + "list_bodies", {}).bodies.size(), 4U);
}

TEST_F(ServicesTest, AddedBodiesHaveTheScenesDefaultsAndGroupsCountAsBodies) {
  AddBodyRequest request;
  request.name = "cup";
  request.frame_id = "cup";
  request.primitive = "sphere";
  request.dimensions = {0.5};
  request.pair_with = {"both"};
  const auto added = call<AddBody>(kNode + "add_body", request);
  ASSERT_TRUE(added.success) << added.message;
  EXPECT_EQ(added.pairs, std::vector<std::string>({"cup/box_a", "cup/box_b"}));
  for (const PairInfo& pair : call<ListBodies>(kNode + "list_bodies", {}).pairs) {
    EXPECT_TRUE(pair.body_a != "cup" || pair.cutoff == 1000.0) << pair.name << ": " << pair.cutoff;
  }
  SetPairEnabledRequest off;
  off.body_a = "cup";
  off.body_b = "both";
  const auto switched = call<SetPairEnabled>(kNode + "set_pair_enabled", off);
  EXPECT_TRUE(switched.success) << switched.message;
  EXPECT_EQ(switched.pair, "cup/box_a");
  EXPECT_EQ(switched.pairs, added.pairs);
  RemoveBodyRequest removal;
  removal.name = "cup";
  EXPECT_TRUE(call<RemoveBody>(kNode + "remove_body", removal).success);
}

TEST_F(ServicesTest, AddBodyRefusesBadRequestsWithTheReason) {
  AddBodyRequest good;
  good.name = "cup";
  good.frame_id = "world";
  good.pose.orientation.w = 1.0;
  good.primitive = "sphere";
  good.dimensions = {0.1};
  const auto expect_bad = [](const AddBodyRequest& request, const std::string& part) {
    const auto response = call<AddBody>(kNode + "add_body", request);
    EXPECT_FALSE(response.success);
    EXPECT_NE(response.message.find(part), std::string::npos) << response.message;
  };
  AddBodyRequest request = good;
  request.primitive = "teapot";
  expect_bad(request, "teapot");
  request = good;
  request.dimensions = {-0.1};
  expect_bad(request, "cup");
  request = good;
  request.primitive = "";
  request.mesh_resource = "/nowhere/cup.stl";
  expect_bad(request, "/nowhere/cup.stl");
  request.mesh_resource = "package://no_such_package/cup.stl";
  expect_bad(request, "no_such_package");
  request = good;
  request.pose.orientation.w = 0.5;
  expect_bad(request, "quaternion");
  request = good;
  request.name = "my cup";
  expect_bad(request, "my cup");
  EXPECT_EQ(call<ListBodies>(kNode + "list_bodies", {}).bodies.size(), 4U);
}

}  // namespace
}  // namespace concave_distance::services_rostest
