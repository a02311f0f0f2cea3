#pragma once

#include "concave_distance/contact/wrench.h"
#include "concave_distance/scene/simulation_settings.h"
#include "pose_path.h"
#include "rigid_body.h"

namespace concave_distance {

/// Says what a compliant drive does to its body at one time.
struct DriveForce {
  Wrench on_body;              ///< spring and damper, about the body's centre of mass, world axes
  double spring_energy = 0.0;  ///< J
  double loss = 0.0;           ///< power that the damper takes, W, >= 0
  double power = 0.0;          ///< that moving the target puts in, W
};

/// Force K (t - p) + D (t' - p') in the target's axes, with p the drive frame's origin and t the target's; p'
/// is measured against the point of the target's frame at p. Torque: minus the gradient of phi' K phi / 2,
/// phi the rotation vector from target to drive frame, so that the spring is conservative where its axes are
/// not equally stiff, and D (omega_target - omega).
/// @param inside a time of the piece of the path that counts for the target's velocity
DriveForce driveForce(const CompliantDrive& drive, const PosePath& target, double time, double inside,
                      const RigidBody& body, const RigidBodyState& state);

}  // namespace concave_distance
