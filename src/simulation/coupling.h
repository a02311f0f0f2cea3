#pragma once

#include <Eigen/Geometry>
#include <cstddef>

#include "concave_distance/contact/contact_linearisation.h"
#include "concave_distance/contact/wrench.h"
#include "concave_distance/scene/simulation_settings.h"
#include "pose_path.h"

namespace concave_distance::detail {

inline constexpr std::size_t kNoBody = static_cast<std::size_t>(-1);

/// Says where a frame is that moves, and how: velocity of `centre`, angular velocity; world axes.
struct FrameMotion {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Vector6d twist = Vector6d::Zero();

  Eigen::Vector3d velocityAt(const Eigen::Vector3d& point) const {
    return twist.head<3>() + Eigen::Vector3d(twist.tail<3>()).cross(point - centre);
  }
};

/// Says how a wrench of a coupling changes, at one time; about A's origin, A's axes, on B.
struct CouplingForce {
  Vector6d wrench = Vector6d::Zero();  ///< N, N m, at `twist`
  Vector6d twist = Vector6d::Zero();   ///< of B against A for which the wrench was evaluated
  ContactLinearisation linearisation;
  bool acts = false;  ///< else wrench and linearisation are zero

  /// The wrench at another twist, to the first order.
  Vector6d wrenchAt(const Vector6d& other) const { return wrench - linearisation.damping * (other - twist); }
};

/// Couples two bodies A and B, or a drive's target (A) and its body (B), in the equations of a step.
struct Coupling {
  std::size_t body_a = kNoBody;  ///< kNoBody: the target of B's drive
  std::size_t body_b = kNoBody;
  CouplingForce force;  ///< now

  // The force acts so at the begin of the step.
  CouplingForce begin;
  Vector6d twist = Vector6d::Zero();  ///< of B against A
  double stiffness_rate = 0.0;        ///< bound on the square of the angular frequencies, 1/s^2
  double damping_rate = 0.0;          ///< bound on the rates of decay, 1/s
  double load = 0.0;                  ///< what else presses on the bodies, N

  // The equations (StepEquations) take these.
  Matrix6d jacobian_a = Matrix6d::Zero();  ///< from A's twist to the relative one
  Matrix6d jacobian_b = Matrix6d::Zero();
  Matrix6d resistance = Matrix6d::Zero();  ///< kg, kg m, kg m^2
  Vector6d change = Vector6d::Zero();      ///< solution: of the relative twist

  // The step that is tried sets these.
  Vector6d impulse = Vector6d::Zero();       ///< N s: of the equations solved last
  Vector6d undamped = Vector6d::Zero();      ///< mean wrench by the trapezoidal rule
  Vector6d used = Vector6d::Zero();          ///< mean wrench of the linear model
  Vector6d first = Vector6d::Zero();         ///< N s: what comes at the begin where not half of `used`
  Vector6d displacement = Vector6d::Zero();  ///< of B against A
  Vector6d full_change = Vector6d::Zero();   ///< of the relative twist over all of the step, as predicted
  double loss = 0.0;                         ///< J, >= 0: what the damping takes of the bodies' energy
  Vector6d residual = Vector6d::Zero();      ///< what the linear model has missed of the wrench at the end
};

/// Returns the map from the twist of a body about its centre, world axes, to that of its point at the frame's
/// origin, the frame's axes.
Matrix6d jacobianAt(const Eigen::Isometry3d& world_from_frame, const Eigen::Vector3d& centre);
/// The twist of B against A at the origin of A's frame, its axes.
Vector6d twistBetween(const Eigen::Isometry3d& world_from_a, const FrameMotion& a, const FrameMotion& b);
inline Wrench toWrench(const Vector6d& wrench) {
  return {wrench.head<3>(), wrench.tail<3>()};
}

/// Returns that of a drive's spring and damper. @param point of the drive's frame, in the target's frame
ContactLinearisation linearisationOf(const CompliantDrive& drive, const Eigen::Vector3d& point_in_target);

}  // namespace concave_distance::detail
