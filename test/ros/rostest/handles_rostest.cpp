// The handles of the interactive demo: in every rviz they are where tf says the body is.
#include <gtest/gtest.h>
#include <ros/publisher.h>
#include <tf2_msgs/TFMessage.h>
#include <visualization_msgs/InteractiveMarkerFeedback.h>
#include <visualization_msgs/InteractiveMarkerInit.h>

#include <cmath>

#include "rostest_support.h"

namespace concave_distance::handles_rostest {
namespace {

using Feedback = visualization_msgs::InteractiveMarkerFeedback;

// Returns what an rviz that is started now would show.
double handleX() {
  Collector<visualization_msgs::InteractiveMarkerInit> handles("/interactive_body/update_full");
  if (!eventually([&] { return handles.count() > 0 && !handles.last()->markers.empty(); })) return NAN;
  return handles.last()->markers.front().pose.position.x;
}

TEST(Handles, FollowTheBodyWhileItSwaysAndAfterItWasDragged) {
  Collector<tf2_msgs::TFMessage> poses("/tf");
  const auto body_x = [&] { return poses.last()->transforms.front().transform.translation.x; };
  ASSERT_TRUE(eventually([&] { return poses.count() > 0; }));
  const double start = body_x();
  ASSERT_TRUE(eventually([&] { return std::abs(body_x() - start) > 0.03; })) << "it sways";
  // The body moves at 0.07 m/s at most; the handles may be one look of this test behind.
  EXPECT_TRUE(eventually([&] { return std::abs(handleX() - body_x()) < 0.02; }));

  ros::NodeHandle node;
  ros::Publisher feedback = node.advertise<Feedback>("/interactive_body/feedback", 10);
  ASSERT_TRUE(eventually([&] { return feedback.getNumSubscribers() > 0; }));
  Feedback drag;
  drag.client_id = "test";
  drag.marker_name = "hook";
  drag.header.frame_id = "world";
  drag.pose.orientation.w = 1.0;
  drag.pose.position.x = 0.5;
  // In their first second the handles take no feedback.
  ASSERT_TRUE(eventually([&] {
    for (const std::uint8_t event : {Feedback::MOUSE_DOWN, Feedback::POSE_UPDATE}) {
      drag.event_type = event;
      feedback.publish(drag);
    }
    return std::abs(body_x() - 0.5) < 1e-9;
  })) << "the body goes where it is dragged";
  EXPECT_TRUE(eventually([&] { return std::abs(handleX() - 0.5) < 1e-9; }))
      << "and the handles of the others";
}

}  // namespace
}  // namespace concave_distance::handles_rostest
