#pragma once

#include <geometry_msgs/TransformStamped.h>

#include <string>

#include "ros/tf/transform_buffer.h"
#include "support/box_scene.h"

namespace concave_distance {

/// Takes transforms of every time: its clock stands at 100 s, the tests begin there.
inline TransformBuffer timelessBuffer() {
  return TransformBuffer({10.0, 1e6}, [] { return ros::Time(100, 0); });
}

/// Puts `child` at (x, 0, 0), turned by `angle` about z so that corners are nearest.
inline void place(TransformBuffer& buffer, const std::string& child, double x, ros::Time stamp,
                  double angle = 0.0, bool fixed = false) {
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = "world";
  transform.header.stamp = stamp;
  transform.child_frame_id = child;
  transform.transform.translation.x = x;
  transform.transform.rotation.z = std::sin(angle / 2.0);
  transform.transform.rotation.w = std::cos(angle / 2.0);
  buffer.insert(transform, "test", fixed);
}

}  // namespace concave_distance
