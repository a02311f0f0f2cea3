/// Broadcasts on tf the pose of an interactive marker that is dragged in rviz: the interactive demo.
///
/// Private parameters: `parent` and `child` (frames), `scale` (size of the handles, metres, 0.35), `rate`
/// (Hz, 100), `x`, `y`, `z`, `roll`, `pitch`, `yaw` (pose at the start), `idle_motion` (true: the body sways
/// on its own until it is taken hold of).

#include <interactive_markers/interactive_marker_server.h>
#include <ros/ros.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/transform_broadcaster.h>
#include <visualization_msgs/InteractiveMarker.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "demo_parameters.h"

namespace {

using namespace concave_distance;

constexpr double kRange = 1e3;        // metres and radians: more is a mistake
constexpr double kHandleRate = 30.0;  // Hz

visualization_msgs::InteractiveMarkerControl makeControl(const std::string& axis, double x, double y,
                                                         double z, std::uint8_t mode) {
  visualization_msgs::InteractiveMarkerControl control;
  control.name = axis + (mode == visualization_msgs::InteractiveMarkerControl::MOVE_AXIS ? "_move" : "_turn");
  // The control acts along the x axis turned by this quaternion.
  const double norm = std::sqrt(1.0 + x * x + y * y + z * z);
  control.orientation.w = 1.0 / norm;
  control.orientation.x = x / norm;
  control.orientation.y = y / norm;
  control.orientation.z = z / norm;
  control.interaction_mode = mode;
  return control;
}

visualization_msgs::InteractiveMarker makeMarker(const std::string& parent, const std::string& child,
                                                 double scale) {
  visualization_msgs::InteractiveMarker marker;
  marker.header.frame_id = parent;
  marker.name = child;
  marker.scale = static_cast<float>(scale);
  using Control = visualization_msgs::InteractiveMarkerControl;
  for (const std::uint8_t mode : {Control::MOVE_AXIS, Control::ROTATE_AXIS}) {
    marker.controls.push_back(makeControl("x", 1, 0, 0, mode));
    marker.controls.push_back(makeControl("y", 0, 0, 1, mode));
    marker.controls.push_back(makeControl("z", 0, 1, 0, mode));
  }
  return marker;
}

Eigen::Isometry3d readStart(const ros::NodeHandle& node) {
  const auto number = [&](const char* name) {
    return demo::numberParameter(node, name, 0.0, -kRange, kRange);
  };
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(number("x"), number("y"), number("z"));
  pose.linear() = (Eigen::AngleAxisd(number("yaw"), Eigen::Vector3d::UnitZ()) *
                   Eigen::AngleAxisd(number("pitch"), Eigen::Vector3d::UnitY()) *
                   Eigen::AngleAxisd(number("roll"), Eigen::Vector3d::UnitX()))
                      .toRotationMatrix();
  return pose;
}

/// A slow figure around the start, so that the scene lives before anybody touches it: low at the ends, high
/// in the middle where the comb's longest tooth is.
Eigen::Isometry3d sway(const Eigen::Isometry3d& start, double time) {
  Eigen::Isometry3d pose = start;
  pose.translation() += Eigen::Vector3d(0.20 * std::sin(0.35 * time), 0.015 * std::sin(0.53 * time),
                                        0.04 * std::cos(0.7 * time));
  pose.linear() =
      start.linear() *
      Eigen::AngleAxisd(0.12 * std::sin(0.41 * time), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return pose;
}

Eigen::Isometry3d fromPose(const geometry_msgs::Pose& message) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(message.position.x, message.position.y, message.position.z);
  pose.linear() = Eigen::Quaterniond(message.orientation.w, message.orientation.x, message.orientation.y,
                                     message.orientation.z)
                      .normalized()
                      .toRotationMatrix();
  return pose;
}

void run() {
  const ros::NodeHandle node("~");
  const std::string parent = demo::requireParameter(node, "parent");
  const std::string child = demo::requireParameter(node, "child");
  const double rate = demo::numberParameter(node, "rate", 100.0, 0.1, 2000.0);
  const double scale = demo::numberParameter(node, "scale", 0.35, 1e-3, kRange);
  const Eigen::Isometry3d start = readStart(node);
  bool idle = ros::param::param(node.resolveName("idle_motion"), true);

  Eigen::Isometry3d pose = start;
  interactive_markers::InteractiveMarkerServer server("interactive_body");
  server.insert(makeMarker(parent, child, scale));
  server.setCallback(child, [&](const visualization_msgs::InteractiveMarkerFeedbackConstPtr& feedback) {
    using Feedback = visualization_msgs::InteractiveMarkerFeedback;
    if (feedback->event_type == Feedback::MOUSE_DOWN) idle = false;
    if (feedback->event_type == Feedback::POSE_UPDATE && !idle) pose = fromPose(feedback->pose);
  });
  // The handles in every rviz, also in one started later, follow the body.
  std::optional<Eigen::Isometry3d> shown;
  const auto show_handles = [&] {
    if (shown && shown->matrix() == pose.matrix()) return;
    server.setPose(child, tf2::toMsg(pose));
    server.applyChanges();
    shown = pose;
  };
  show_handles();

  tf2_ros::TransformBroadcaster broadcaster;
  ros::NodeHandle public_node;
  // Less often than the poses, because rviz starts over when it loses one of the server's messages.
  const ros::Timer handle_timer = public_node.createTimer(ros::Duration(1.0 / std::min(rate, kHandleRate)),
                                                          [&](const ros::TimerEvent&) { show_handles(); });
  demo::playAtRate(rate, [&](double time, const ros::Time& now) {
    if (idle) pose = sway(start, time);
    broadcaster.sendTransform(demo::toTransform(pose, now, parent, child));
  });
}

}  // namespace

int main(int argc, char** argv) {
  return concave_distance::demo::runNode(argc, argv, "marker_mover", run);
}
