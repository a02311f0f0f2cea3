#pragma once

#include <ros/node_handle.h>

#include <map>
#include <string>

#include "concave_distance/loading/load_scene.h"
#include "concave_distance/loading/resource_locator.h"
#include "concave_distance/scene/scene.h"
#include "node_parameters.h"

namespace concave_distance {

/// Folder of a ROS package by rospack; empty when it is not known.
std::string rosPackagePath(const std::string& package);

/// Holds what the parameter server has for a scene.
struct SceneRequest {
  std::map<std::string, std::string> descriptions;  ///< texts by parameter name
  std::string waiting_for;                          ///< what is not there yet; empty: the scene can be loaded
};

/// Reads the robot descriptions that the scene file or `~robot_description` names. Does not wait.
/// @throws Error for a wrong scene file
SceneRequest requestScene(const NodeParameters& parameters, const ros::NodeHandle& node);

/// Logs notes, warnings and problems, and how long it took. @param seconds of wall time
void logScene(const Scene& scene, double seconds);

/// Loads the scene. A robot whose URDF cannot be read becomes a problem of the scene, as does a broken mesh.
/// Takes as long as preparing the bodies; calls ROS only to find packages.
/// @throws Error for a wrong scene file
Scene loadScene(const NodeParameters& parameters, const SceneRequest& request, LoadProgress& progress);

}  // namespace concave_distance
