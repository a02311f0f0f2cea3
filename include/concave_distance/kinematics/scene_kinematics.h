#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "concave_distance/kinematics/robot_kinematics.h"
#include "concave_distance/scene/scene.h"

namespace concave_distance {

/// Where the robots and bodies of a scene are, in one frame, the world.
struct SceneState {
  std::vector<RobotState> robots;  ///< in the order of SceneKinematics::robots()
  /// In the order of Scene::bodies, for SceneTracker::update(); empty where it is not known.
  std::vector<std::optional<Eigen::Isometry3d>> world_from_body;
};

/// The joints of all robots of a scene: their positions and velocities are those of the robots, one after the
/// other. Belongs to one revision of a scene; immutable, so that threads may share one.
class SceneKinematics {
 public:
  /// Names the link that a body is fixed to.
  struct Place {
    std::size_t robot = 0;
    std::size_t link = 0;
  };

  /// Takes the robots that have a body in the scene. @throws Error when joints of two robots have one name
  explicit SceneKinematics(const Scene& scene);

  const std::vector<std::shared_ptr<const RobotKinematics>>& robots() const { return robots_; }
  /// Returns where a body is; nothing when it is on no robot.
  const std::optional<Place>& placeOf(std::size_t body) const { return places_[body]; }
  /// Returns whether a joint moves the body against the root of its robot.
  bool isMoved(std::size_t body) const {
    return places_[body] && robots_[places_[body]->robot]->isMoved(places_[body]->link);
  }
  /// The pose of a body in its link, or in its frame when it is on no robot.
  const Eigen::Isometry3d& frameFromBody(std::size_t body) const { return frame_from_body_[body]; }
  std::size_t bodyCount() const { return places_.size(); }
  /// SceneBody::serial, which edits of the scene keep.
  std::uint64_t serialOf(std::size_t body) const { return serials_[body]; }
  /// SceneBody::name.
  const std::string& nameOf(std::size_t body) const { return names_[body]; }

  /// As those of RobotKinematics, of all robots.
  const std::vector<std::string>& positionNames() const { return position_names_; }
  const std::vector<std::string>& velocityNames() const { return velocity_names_; }
  std::size_t firstPosition(std::size_t robot) const { return first_position_[robot]; }
  std::size_t firstVelocity(std::size_t robot) const { return first_velocity_[robot]; }
  Eigen::VectorXd restPositions() const;
  /// @throws Error as positionsOfRobots(), and for a robot that is not named
  Eigen::VectorXd positionsOf(const std::vector<std::string>& names, const std::vector<double>& values) const;
  /// Positions of each robot that is named; nothing for the others. @throws Error as
  /// RobotKinematics::positionsOf(), and for a robot that has left the scene
  std::vector<std::optional<Eigen::VectorXd>> positionsOfRobots(const std::vector<std::string>& names,
                                                                const std::vector<double>& values) const;

  /// The state to begin with: robots at restPositions() with their roots at the world's origin; bodies on no
  /// robot where they are in `world`, and nowhere when they are in another frame.
  SceneState startState(const std::string& world = "world") const;
  /// Computes where all links and the bodies on them are; other bodies and the roots stay. Allocates nothing.
  /// @param state of startState(), the roots of robots and other bodies set as they are
  /// @throws Error as RobotKinematics::evaluate()
  void evaluate(const Eigen::Ref<const Eigen::VectorXd>& positions, SceneState& state) const;
  /// Places the bodies on a robot by its state alone.
  void placeBodies(std::size_t robot, SceneState& state) const;

 private:
  std::vector<std::shared_ptr<const RobotKinematics>> robots_;
  std::vector<std::optional<Place>> places_;
  std::vector<Eigen::Isometry3d> frame_from_body_;
  std::vector<std::string> frames_;  ///< of the bodies
  std::vector<std::uint64_t> serials_;
  std::vector<std::string> names_;
  RigidFrames rigid_;
  std::vector<std::string> position_names_;
  std::vector<std::string> velocity_names_;
  std::vector<std::size_t> first_position_;
  std::vector<std::size_t> first_velocity_;
  std::unordered_map<std::string, std::size_t> robot_of_;  ///< by the name of a joint or of its number
  std::unordered_map<std::string, std::string> left_;      ///< names of joints and robots that have left
};

}  // namespace concave_distance
