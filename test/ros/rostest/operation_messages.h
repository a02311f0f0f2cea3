#pragma once

#include <concave_distance/SceneOperation.h>
#include <geometry_msgs/Pose.h>

#include <cstdint>
#include <string>

namespace concave_distance {

inline geometry_msgs::Pose at(double x, double y = 0.0, double z = 0.0) {
  geometry_msgs::Pose pose;  // its orientation is left at zeros, as messages come
  pose.position.x = x;
  pose.position.y = y;
  pose.position.z = z;
  return pose;
}

inline SceneOperation operation(std::uint8_t kind, const std::string& body, const std::string& other = "") {
  SceneOperation message;
  message.operation = kind;
  message.body = body;
  message.other = other;
  return message;
}

}  // namespace concave_distance
