// A robot without a scene file, and obstacles that come and go while the node runs.
#include <concave_distance/AddBody.h>
#include <concave_distance/Alert.h>
#include <concave_distance/Distances.h>
#include <concave_distance/GetDistance.h>
#include <concave_distance/ListBodies.h>
#include <concave_distance/RemoveBody.h>
#include <concave_distance/SetPairEnabled.h>
#include <concave_distance/SetWarningDistance.h>
#include <gtest/gtest.h>
#include <ros/param.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "node_access.h"
#include "tf_player.h"

namespace concave_distance::obstacles_rostest {
namespace {

AddBodyRequest box(const std::string& name, const std::string& frame) {
  AddBodyRequest request;  // its orientation is left at zeros, as messages come
  request.name = name;
  request.frame_id = frame;
  request.primitive = "box";
  request.dimensions = {1.0, 1.0, 1.0};
  return request;
}

void remove(const std::string& name) {
  RemoveBodyRequest request;
  request.name = name;
  EXPECT_TRUE(call<RemoveBody>(kNode + "remove_body", request).success) << name;
}

class Obstacles : public ::testing::Test {
 protected:
  Obstacles() {
    player.place("base", 0.0);
    player.place("arm", 3.0);
    player.place("tool", 6.0);
    EXPECT_TRUE(eventually([] { return call<ListBodies>(kNode + "list_bodies", {}).ready != 0; }));
  }
  TfPlayer player;
};

TEST_F(Obstacles, ARobotAloneHasACutoffOfItsSizeAndSoHaveAddedBodies) {
  const auto list = call<ListBodies>(kNode + "list_bodies", {});
  ASSERT_EQ(list.pairs.size(), 1U) << "base/tool: the others are adjacent or bolted together";
  const double wanted = 0.2 * std::sqrt(7.0 * 7.0 + 1.0 + 1.0);
  EXPECT_NEAR(list.pairs[0].cutoff, wanted, 0.1 * wanted);
  ASSERT_TRUE(call<AddBody>(kNode + "add_body", box("crate", "crate_frame")).success);
  for (const PairInfo& pair : call<ListBodies>(kNode + "list_bodies", {}).pairs) {
    EXPECT_EQ(pair.cutoff, list.pairs[0].cutoff) << pair.name;
  }
  remove("crate");
  EXPECT_FALSE(ros::param::has(kNode + "cutoff")) << "the next start would take it for the user's";
  for (const auto& value : reconfigure("least_prominence", 0.02).strs) {
    if (value.name == "cutoff") {
      EXPECT_NEAR(std::stod(value.value), wanted, 0.1 * wanted) << value.value;
    }
  }
}

TEST_F(Obstacles, ABodyOnALinkIsNotWatchedAgainstTheLinksRigidNeighbours) {
  const auto added = call<AddBody>(kNode + "add_body", box("cup", "tool"));
  ASSERT_TRUE(added.success) << added.message;
  EXPECT_EQ(added.pairs, std::vector<std::string>{"cup/base"});
  EXPECT_NE(added.message.find("arm"), std::string::npos) << added.message;
  remove("cup");

  AddBodyRequest request = box("cup", "tool");
  request.touch_links = {"base", "no_such_link"};
  const auto touching = call<AddBody>(kNode + "add_body", request);
  EXPECT_TRUE(touching.success);
  EXPECT_TRUE(touching.pairs.empty());
  EXPECT_NE(touching.message.find("no_such_link"), std::string::npos) << touching.message;
  remove("cup");

  request.touch_links.clear();
  request.pair_with = {"arm"};
  EXPECT_EQ(call<AddBody>(kNode + "add_body", request).pairs, std::vector<std::string>{"cup/arm"});
  remove("cup");
  request.touch_links = {"base"};
  EXPECT_FALSE(call<AddBody>(kNode + "add_body", request).success) << "both say whom to watch";
}

TEST_F(Obstacles, StaticTransformsMakeRigidNeighboursToo) {
  tf2_ros::StaticTransformBroadcaster broadcaster;
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = "base";
  transform.child_frame_id = "camera";
  transform.transform.rotation.w = 1.0;
  broadcaster.sendTransform(transform);
  AddBodyResponse added;
  EXPECT_TRUE(eventually([&] {
    added = call<AddBody>(kNode + "add_body", box("lens", "camera"));
    remove("lens");
    return added.pairs.size() == 2;
  })) << "the transform has arrived: "
      << added.message;
  EXPECT_EQ(added.pairs, (std::vector<std::string>{"lens/arm", "lens/tool"}));
}

TEST_F(Obstacles, AFrameThatIsNotOnTfIsWarnedAbout) {
  const auto added = call<AddBody>(kNode + "add_body", box("crate", "nowhere"));
  EXPECT_TRUE(added.success);
  EXPECT_NE(added.message.find("'nowhere' is not on tf"), std::string::npos) << added.message;
  remove("crate");
  const auto known = call<AddBody>(kNode + "add_body", box("crate", "world"));
  EXPECT_TRUE(known.success);
  EXPECT_EQ(known.message, "");
  remove("crate");
}

TEST_F(Obstacles, AnOrientationOfZerosIsNoRotation) {
  GetDistanceRequest request;
  request.query.body_a = "base";
  request.query.body_b = "tool";
  request.query.use_pose_a = request.query.use_pose_b = 1;
  request.query.pose_b.pose.position.y = 2.0;
  const auto answer = call<GetDistance>(kNode + "get_distance", request);
  EXPECT_TRUE(answer.success) << answer.message;
  EXPECT_NEAR(answer.result.nearest.distance, 1.0, kRounding);
}

TEST_F(Obstacles, ARobotsLinkIsRemovedOnlyOnRequest) {
  RemoveBodyRequest request;
  request.name = "arm";
  const auto refused = call<RemoveBody>(kNode + "remove_body", request);
  EXPECT_FALSE(refused.success);
  EXPECT_NE(refused.message.find("allow_robot_link"), std::string::npos) << refused.message;
  EXPECT_EQ(call<ListBodies>(kNode + "list_bodies", {}).bodies.size(), 3U);
}

TEST_F(Obstacles, WarningDistancesAreSetAndTakenAwayWhileItRuns) {
  AddBodyRequest crate = box("crate", "world");
  crate.pose.position.x = 6.0;
  crate.pose.position.y = 1.5;  // half a metre beside the tool
  ASSERT_TRUE(call<AddBody>(kNode + "add_body", crate).success);
  Collector<Distances> distances(kNode + "distances");
  Collector<Alert> alerts(kNode + "alerts");
  SetWarningDistanceRequest request;
  request.pair = "crate/*";
  request.warning_distance = 0.8;
  request.warning_hysteresis = 0.1;
  const auto set = call<SetWarningDistance>(kNode + "set_warning_distance", request);
  ASSERT_TRUE(set.success) << set.message;
  EXPECT_EQ(set.pairs.size(), 3U);
  const auto came = [&](std::uint8_t state) {
    return eventually([&] {
      const std::vector<Alert> all = alerts.all();
      return std::any_of(all.begin(), all.end(), [&](const Alert& alert) {
        return alert.nearest.pair == "crate/tool" && alert.state == state;
      });
    });
  };
  EXPECT_TRUE(came(Alert::WARNING));
  for (const double bad : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
    request.warning_distance = bad;
    EXPECT_FALSE(call<SetWarningDistance>(kNode + "set_warning_distance", request).success) << bad;
  }
  alerts.clear();
  request.remove = 1;
  EXPECT_TRUE(call<SetWarningDistance>(kNode + "set_warning_distance", request).success);
  EXPECT_TRUE(came(Alert::CLEAR)) << "what was raised is taken back";
  remove("crate");
}

}  // namespace
}  // namespace concave_distance::obstacles_rostest
