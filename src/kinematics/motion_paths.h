#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "concave_distance/kinematics/clearance.h"
#include "motion_curve.h"

namespace concave_distance::detail {

/// Moves one piece of a robot against the next: a joint that the motion names, or one part of it.
struct PathElement {
  enum class Kind : std::uint8_t {
    Turn,   ///< about `axes.col(0)`, by the angle of `curve`
    Slide,  ///< along `axes.col(0)`, by `curve`
    Shift,  ///< along the three axes, by `curve` and the two behind it
    Slerp   ///< by `turns`; `curve` is the angle that has passed, in all
  };
  Kind kind = Kind::Turn;
  /// The pose that it starts from, in the frame that the element before it moves.
  Eigen::Isometry3d before = Eigen::Isometry3d::Identity();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  std::size_t curve = 0;
  std::size_t turns = 0;  ///< place in MotionPaths::turns

  bool isTurning() const { return kind == Kind::Turn || kind == Kind::Slerp; }
};

/// Rotations of waypoints and how each turns to the next.
struct WaypointTurns {
  std::vector<Eigen::Matrix3d> rotations;  ///< of the first waypoint of each segment
  std::vector<Eigen::Vector3d> axes;       ///< of each segment, in the axes that the rotation is in
};

/// The path from the world, or the root of a robot, to a body: what moves it, and where it is behind that.
struct BodyPath {
  std::vector<std::size_t> elements;                        ///< places in MotionPaths::elements
  Eigen::Isometry3d start = Eigen::Isometry3d::Identity();  ///< world, before the first element
  Eigen::Isometry3d tail = Eigen::Isometry3d::Identity();   ///< the body behind the last element
};

/// All that moves, and on which curves.
struct MotionPaths {
  std::vector<MotionCurve> curves;
  std::vector<PathElement> elements;
  std::vector<WaypointTurns> turns;
  std::vector<std::optional<BodyPath>> bodies;  ///< of the scene; empty where the pose is not known
  std::vector<double> times;                    ///< s, of the waypoints
  std::vector<std::string> outside_limits;
  bool velocities_ignored = false;

  std::size_t segmentCount() const { return times.size() > 1 ? times.size() - 1 : 1; }
  double end() const { return static_cast<double>(times.size() - 1); }  ///< the last moment
  double timeOf(double moment) const;
};

/// @throws Error as findClearance()
MotionPaths pathsOf(const SceneKinematics& joints, const SceneState& state, const JointMotion& motion);
MotionPaths pathsOf(const Scene& scene, const SceneKinematics& joints, const SceneState& state,
                    const PoseMotion& motion);

}  // namespace concave_distance::detail
