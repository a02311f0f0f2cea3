#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <ros/ros.h>

#include <Eigen/Geometry>
#include <string>

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

}  // namespace concave_distance::demo
