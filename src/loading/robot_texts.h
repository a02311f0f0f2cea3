#pragma once

#include <string>

#include "concave_distance/loading/load_scene.h"
#include "scene_parts.h"

namespace concave_distance::detail {

/// Returns the text of a scene file, URDF or SRDF. @throws Error naming `where`
std::string readTextFile(const std::string& path, const std::string& where);

/// Returns the folder of a file; "." for one in the working folder.
std::string folderOf(const std::string& path);

/// Adds a robot of a scene with what its URDF and SRDF say. One that cannot be read is a problem of the
/// scene, which is served without it. @throws Error for a parameter that is missing, as addRobot() and
/// addSemantics()
void readRobot(const RobotSpec& spec, const std::string& base_folder, const SceneLoadOptions& options,
               SceneParts& parts);

/// Adds what the robot's SRDF says, where it has one; the same about problems and errors.
void readSemantics(const RobotSpec& spec, const RobotDescription& robot, const std::string& base_folder,
                   const SceneLoadOptions& options, SceneParts& parts);

}  // namespace concave_distance::detail
