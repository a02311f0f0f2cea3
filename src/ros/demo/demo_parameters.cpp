#include "demo_parameters.h"

#include <tf2_eigen/tf2_eigen.h>

#include <ros/package.h>

#include "base/number_text.h"
#include "concave_distance/base/error.h"
#include "concave_distance/loading/resource_locator.h"

namespace concave_distance::demo {

std::string requireParameter(const ros::NodeHandle& node, const std::string& name) {
  std::string value;
  if (!node.getParam(name, value) || value.empty()) {
    throw Error(node.resolveName(name), "is not set", "set it to a text");
  }
  return value;
}

double numberParameter(const ros::NodeHandle& node, const std::string& name, double fallback, double least,
                       double most) {
  double value = fallback;
  if (node.hasParam(name) && !node.getParam(name, value)) {
    throw Error(node.resolveName(name), "is no number", "set it to a number");
  }
  if (!(value >= least && value <= most)) {
    throw Error(node.resolveName(name), "is " + numberText(value),
                "set it from " + numberText(least) + " to " + numberText(most));
  }
  return value;
}

std::string fileParameter(const ros::NodeHandle& node, const std::string& name) {
  return locateResource(requireParameter(node, name), "",
                        [](const std::string& package) { return ros::package::getPath(package); });
}

geometry_msgs::TransformStamped toTransform(const Eigen::Isometry3d& parent_from_child,
                                            const ros::Time& stamp, const std::string& parent,
                                            const std::string& child) {
  geometry_msgs::TransformStamped message = tf2::eigenToTransform(parent_from_child);
  message.header.stamp = stamp;
  message.header.frame_id = parent;
  message.child_frame_id = child;
  return message;
}

}  // namespace concave_distance::demo
