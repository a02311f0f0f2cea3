#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <ros/ros.h>

#include <Eigen/Geometry>
#include <string>

#include "concave_distance/base/error.h"
#include "ros/time_difference.h"

namespace concave_distance::demo {

/// A required private parameter. @throws Error naming it when it is missing
std::string requireParameter(const ros::NodeHandle& node, const std::string& name);

/// A private parameter with a number in a range. @throws Error naming parameter, value and range
double numberParameter(const ros::NodeHandle& node, const std::string& name, double fallback, double least,
                       double most);

/// The parameter's resource (package://, file:// or a path) as a path. @throws Error when it cannot be found
std::string fileParameter(const ros::NodeHandle& node, const std::string& name);

geometry_msgs::TransformStamped toTransform(const Eigen::Isometry3d& parent_from_child,
                                            const ros::Time& stamp, const std::string& parent,
                                            const std::string& child);

/// Calls act(time, now) at the parameter `rate` until the program ends; `time` is seconds since the first
/// call. A clock that jumps back begins anew.
template <typename Act>
void playAtRate(double rate, const Act& act) {
  ros::NodeHandle public_node;
  ros::Time first;
  const ros::Timer timer = public_node.createTimer(ros::Duration(1.0 / rate), [&](const ros::TimerEvent&) {
    const ros::Time now = ros::Time::now();
    if (first.isZero() || now < first) first = now;
    act(secondsBetween(first, now), now);
  });
  ros::spin();
}

/// Runs `main` of a demo node: an Error ends it with a message.
inline int runNode(int argc, char** argv, const char* name, void (*run)()) {
  ros::init(argc, argv, name);
  try {
    run();
  } catch (const Error& error) {
    ROS_FATAL_STREAM(error.what());
    return 1;
  }
  return 0;
}

}  // namespace concave_distance::demo
