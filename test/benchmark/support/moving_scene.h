#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <string>

#include "concave_distance/kinematics/scene_kinematics.h"
#include "concave_distance/scene/scene.h"

namespace concave_distance::benchmark {

/// A scene whose bodies move with one robot.
struct MovingScene {
  std::string name;
  Scene scene;
  /// Positions of joints by name at a time, seconds.
  std::function<std::map<std::string, double>(double)> joints;

  /// Sets the positions that a time gives, in the order of the scene's joints; others stay.
  void move(double time, const SceneKinematics& kinematics, Eigen::VectorXd& positions) const;
};

/// @param scene `robot` or `cell`: the arm of the demo scenes on its path; or ROBOT.urdf[,ROBOT.srdf]: a
/// robot beside itself, as the node loads it without a scene file, every joint of which sways
/// @throws Error for a file that cannot be read
MovingScene movingScene(const std::string& scene);

}  // namespace concave_distance::benchmark
