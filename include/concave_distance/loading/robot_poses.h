#pragma once

#include <Eigen/Geometry>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "concave_distance/scene/scene.h"

namespace concave_distance {

/// Computes where the links of a robot are for given joint positions, without tf.
class RobotPoses {
 public:
  /// @param urdf its text @param where names it in errors
  /// @param prefix what a scene file gives the robot as `prefix`; with two robots, one RobotPoses for each
  /// @throws Error when urdfdom cannot parse the text
  explicit RobotPoses(const std::string& urdf, const std::string& where = "URDF",
                      const std::string& prefix = "");
  ~RobotPoses();
  RobotPoses(RobotPoses&&) noexcept;
  RobotPoses& operator=(RobotPoses&&) noexcept;

  /// Names of the joints that move, in the order of the URDF; none that mimics another.
  std::vector<std::string> jointNames() const;

  /// Poses in the frame of the robot's root link, one for each of scene.bodies; empty for a body that is
  /// fixed to no link of this robot. For SceneTracker::update.
  /// @param positions rad or m; joints that are not named stay at zero, or in the middle of their range if
  ///        zero is outside. Joints of more than one degree of freedom stay at zero.
  /// @throws Error for a name that is none of jointNames(), for a position that is not finite, and when the
  ///         scene has bodies but none that is fixed to a link of this robot: another URDF or prefix
  std::vector<std::optional<Eigen::Isometry3d>> of(const Scene& scene,
                                                   const std::map<std::string, double>& positions) const;

 private:
  struct Robot;
  std::unique_ptr<Robot> robot_;
};

}  // namespace concave_distance
