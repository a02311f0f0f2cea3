// The same class in a nodelet manager.
#include <concave_distance/Distances.h>
#include <concave_distance/GetDistance.h>
#include <concave_distance/ListBodies.h>
#include <gtest/gtest.h>
#include <nodelet/NodeletUnload.h>

#include "rostest_support.h"
#include "tf_player.h"

namespace concave_distance::nodelet_rostest {
namespace {

TEST(Nodelet, ServesAsTheNodeDoesAndCanBeUnloaded) {
  TfPlayer player;
  player.place("box_a", 0.0);
  player.place("box_b", 2.0);
  player.place("ball", 0.0, 3.0);
  {
    Collector<Distances> distances("/distance_nodelet/distances");
    ASSERT_TRUE(distances.waitFor([](const Distances& message) {
      return message.pairs.size() == 2 && message.pairs[0].has_distance && message.pairs[1].has_distance;
    }));
    GetDistanceRequest request;
    request.query.body_a = "box_a";
    request.query.body_b = "box_b";
    EXPECT_TRUE(call<GetDistance>("/distance_nodelet/get_distance", request).success);
  }
  nodelet::NodeletUnloadRequest request;
  request.name = "/distance_nodelet";
  EXPECT_TRUE(call<nodelet::NodeletUnload>("/manager/unload_nodelet", request).success);
  EXPECT_TRUE(eventually([] { return !ros::service::exists("/distance_nodelet/get_distance", false); }));
}

TEST(Nodelet, WithAWrongSceneFileLeavesItsManagerAlive) {
  ListBodiesResponse list;
  EXPECT_TRUE(eventually([&] {
    list = call<ListBodies>("/broken_nodelet/list_bodies", {});
    return list.message.find("broken.yaml") != std::string::npos;
  })) << list.message;
  EXPECT_FALSE(list.ready);
}

}  // namespace
}  // namespace concave_distance::nodelet_rostest
