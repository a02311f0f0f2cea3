#pragma once

#include <optional>
#include <vector>

#include "concave_distance/scene/scene.h"
#include "concave_distance/scene/simulation_settings.h"
#include "concave_distance/simulation/simulation.h"
#include "coupling.h"
#include "drive_force.h"
#include "pose_path.h"
#include "rigid_body.h"
#include "step_equations.h"

namespace concave_distance::detail {

/// Works of one force on a body over a step: trapezoidal in the wrenches, along the way.
inline double trapezoidalWork(const Wrench& before, const Wrench& after, const Eigen::Vector3d& shift,
                              const Eigen::Vector3d& turn) {
  return 0.5 * ((before.force + after.force).dot(shift) + (before.torque + after.torque).dot(turn));
}

/// A body of the simulation with what acts on it besides contacts.
class MovingBody {
 public:
  MovingBody(const SceneBody& body, const SimulatedBodySettings& settings);

  bool isFree() const { return rigid_.has_value(); }
  bool moves() const { return motion_ != BodyMotion::Fixed; }
  /// No point of the body is farther from the reference point (the centre of mass, or the frame's origin of a
  /// body that is not free), metres.
  double radius() const { return radius_; }
  const RigidBody& rigid() const { return *rigid_; }
  const RigidBodyState& state() const { return state_; }

  /// The first time after `time` at which something about the body's loads or paths changes.
  double nextEvent(double time) const;
  /// Returns the motion of the centre of mass, or of the frame's origin of a body that is not free. @param
  /// inside a time within the step
  FrameMotion motionAt(double time, double inside) const { return motionOf(state_, time, inside); }
  FrameMotion motionOf(const RigidBodyState& state, double time, double inside) const;
  StepEquations::Inertia inertia() const;

  /// Loads at a state. @param external on top of the scene's, about the centre of mass
  void evaluateLoad(double inside, const RigidBodyState& state, const Wrench& external);
  const Wrench& load() const { return load_now_; }
  /// Gravity and loads about the centre of mass.
  Wrench steadyWrench(const Eigen::Vector3d& gravity) const;

  bool hasDrive() const { return drive_.has_value(); }
  void setDriveTarget(const Eigen::Isometry3d& pose);
  Eigen::Isometry3d targetPose(double time) const { return target_->poseAt(time); }
  FrameMotion targetMotion(double time, double inside) const;
  void evaluateDrive(double time, double inside, const RigidBodyState& state);
  const DriveForce& drive() const { return drive_now_; }
  ContactLinearisation driveLinearisation(double time) const;
  /// Returns how far its force stretches the stiffest of its springs, metres.
  double driveStretch() const;

  /// The parts of a step: begin, kick, drift, kick; restore() returns to the begin.
  void begin() { before_ = state_; }
  void restore() { state_ = before_; }
  const RigidBodyState& before() const { return before_; }
  /// @return path of the reference point and turn
  Drift drift(double time, double step);
  void kick(const Wrench& about_centre, double step);
  RigidBodyState kicked(const Wrench& about_centre, double step) const;

  /// Pose and velocities as others see them. @param inside a time of the path's piece that counts
  void report(double time, double inside, SimulatedBody& body) const;

 private:
  BodyMotion motion_;
  Eigen::Isometry3d fixed_pose_;
  std::optional<RigidBody> rigid_;
  RigidBodyState state_;
  RigidBodyState before_;
  double radius_ = 0.0;
  std::optional<PosePath> path_;
  std::optional<CompliantDrive> drive_;
  std::optional<PosePath> target_;
  std::vector<AppliedLoad> loads_;
  DriveForce drive_now_;
  Wrench load_now_;
};

}  // namespace concave_distance::detail
