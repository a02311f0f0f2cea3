#pragma once

#include <optional>
#include <vector>

#include "concave_distance/scene/scene.h"
#include "concave_distance/scene/simulation_settings.h"
#include "concave_distance/simulation/simulation.h"
#include "drive_force.h"
#include "pose_path.h"
#include "rigid_body.h"

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
  /// A bound on the speed of any point against the reference point, m/s, at the present rates.
  double spinSpeed(double inside) const;
  Eigen::Vector3d referenceVelocity(double inside) const;
  double angularSpeed(double inside) const;

  /// Drives and loads at a state. @param inside a time within the step
  void evaluateExternal(double time, double inside, const RigidBodyState& state, const Wrench& external);
  const DriveForce& drive() const { return drive_now_; }
  const Wrench& load() const { return load_now_; }
  bool hasDrive() const { return drive_.has_value(); }
  void setDriveTarget(const Eigen::Isometry3d& pose);
  /// Square of the highest frequency and rate of damping of the drive, 1/s^2 and 1/s.
  double driveStiffnessRate() const;
  double driveDampingRate() const;

  /// The first half of a step: kick and drift. @param contact wrench about the centre @return path of the
  /// reference point and turn
  Drift advance(double time, double step, const Wrench& contact, const Eigen::Vector3d& gravity);
  void restore() { state_ = before_; }
  const RigidBodyState& before() const { return before_; }
  /// The state with velocities extrapolated to the end of the step.
  RigidBodyState extrapolated(double step, const Wrench& contact, const Eigen::Vector3d& gravity) const;
  void kick(const Wrench& contact, const Eigen::Vector3d& gravity, double step);
  Wrench total(const Wrench& contact, const Eigen::Vector3d& gravity) const;

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
