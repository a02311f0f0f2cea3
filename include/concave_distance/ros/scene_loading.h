#pragma once

#include <ros/node_handle.h>

#include <optional>
#include <string>

#include "concave_distance/ros/node_parameters.h"
#include "concave_distance/scene/resource_locator.h"
#include "concave_distance/scene/scene.h"

namespace concave_distance {

/// Folder of a ROS package by rospack; empty when it is not known.
std::string rosPackagePath(const std::string& package);

struct LoadAttempt {
  std::optional<Scene> scene;
  std::string waiting_for;  ///< why there is no scene yet
};

/// Loads the scene that the parameters name, once every robot description it refers to is on the parameter
/// server. A robot whose URDF cannot be read becomes a problem of the scene, as a broken mesh does.
/// @throws Error for a scene file that is wrong in itself
LoadAttempt tryLoadScene(const NodeParameters& parameters, const ros::NodeHandle& node);

}  // namespace concave_distance
