// The node under a simulated clock: before it runs, while it runs, and when it jumps back.
#include <concave_distance/Distances.h>
#include <concave_distance/GetDistance.h>
#include <concave_distance/PairNiches.h>
#include <gtest/gtest.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <algorithm>
#include <functional>
#include <string>

#include "node_access.h"
#include "simulated_clock.h"
#include "tf_player.h"

namespace concave_distance::clock_rostest {
namespace {

geometry_msgs::TransformStamped standInWorld() {
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = "world";
  transform.child_frame_id = "stand";
  transform.transform.translation.y = -3.0;
  transform.transform.rotation.w = 1.0;
  return transform;
}

std::function<bool(const Distances&)> isSolved(const std::string& pair) {
  return [pair](const Distances& message) {
    return std::any_of(message.pairs.begin(), message.pairs.end(), [&](const PairDistance& distance) {
      return distance.pair == pair && distance.has_distance != 0;
    });
  };
}

TEST(SimulatedClock, IsWaitedForFollowedAndMayJumpBack) {
  SimulatedClock clock;
  TfPlayer player;
  player.place("box_a", 0.0);
  player.place("box_b", 2.0);
  tf2_ros::StaticTransformBroadcaster static_broadcaster;
  static_broadcaster.sendTransform(standInWorld());
  Collector<PairNiches> niches(kNode + "pairs/boxes/niches");

  GetDistanceRequest request;
  request.query.body_a = "box_a";
  request.query.body_b = "box_b";
  request.query.use_pose_a = request.query.use_pose_b = 1;
  request.query.pose_a.pose.orientation.w = request.query.pose_b.pose.orientation.w = 1.0;
  request.query.pose_b.pose.position.x = 3.0;
  EXPECT_TRUE(eventually([&] { return call<GetDistance>(kNode + "get_distance", request).success != 0; }))
      << "services answer before the first /clock";
  request.query.use_pose_a = 0;
  EXPECT_FALSE(call<GetDistance>(kNode + "get_distance", request).success)
      << "there is no tf yet; the call returns all the same";
  EXPECT_EQ(niches.count(), 0U);

  clock.set(1000.0);
  ASSERT_TRUE(niches.waitFor([](const PairNiches& message) { return message.warm && message.cycle > 20; }));
  EXPECT_GT(niches.last()->header.stamp, ros::Time(1000.0));
  const std::uint64_t id = niches.last()->nearest.nearest_niche_id;

  Collector<Distances> distances(kNode + "distances");
  ASSERT_TRUE(distances.waitFor(isSolved("on_stand"))) << "a body on a static frame";

  clock.set(10.0);
  EXPECT_TRUE(niches.waitFor([&](const PairNiches& message) {
    return message.header.stamp < ros::Time(100.0) && message.warm && message.nearest.has_distance;
  })) << "it goes on in the new time";
  EXPECT_GT(niches.last()->nearest.nearest_niche_id, id) << "tracked niches of the other time are gone";
  distances.clear();
  EXPECT_TRUE(distances.waitFor(isSolved("on_stand"))) << "static transforms, sent once, outlive the jump";
  EXPECT_TRUE(distances.last()->header.stamp < ros::Time(100.0));
  EXPECT_TRUE(call<GetDistance>(kNode + "get_distance", request).success) << "services go on";
  const std::vector<PairNiches> all = niches.all();
  const auto jump = std::find_if(all.begin(), all.end(), [](const PairNiches& message) {
    return message.header.stamp < ros::Time(100.0) && message.nearest.has_distance;
  });
  ASSERT_NE(jump, all.end());
  EXPECT_FALSE(jump->warm);
  EXPECT_FALSE(jump->nearest.has_closing_speed);
}

}  // namespace
}  // namespace concave_distance::clock_rostest
