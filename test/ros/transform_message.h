#pragma once

#include <geometry_msgs/TransformStamped.h>

#include <string>

namespace concave_distance::test {

/// `child` at (x, 0, 0) of `parent`, not turned.
inline geometry_msgs::TransformStamped transformOf(const std::string& child, double x, ros::Time stamp,
                                                   const std::string& parent = "world") {
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = parent;
  transform.header.stamp = stamp;
  transform.child_frame_id = child;
  transform.transform.translation.x = x;
  transform.transform.rotation.w = 1.0;
  return transform;
}

}  // namespace concave_distance::test
