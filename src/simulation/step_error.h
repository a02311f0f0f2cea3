#pragma once

#include "coupling.h"

namespace concave_distance::detail {

/// Returns the part of a point's displacement across `normal`, as a share of all of it; 0 without any.
double shareAcross(const Vector6d& displacement, const Eigen::Vector3d& point, const Eigen::Vector3d& normal);

/// Says how large a coupling's part in the error of the energy may be in one step, joules.
struct StepTolerance {
  double energy_of_motion = 0.0;  ///< of B against A, J
  double load = 0.0;              ///< that presses them together, N
  double depth = 0.0;             ///< of the contact, or stretch of the drive, metres
  double size = 0.0;              ///< of the smaller body, metres
  double work = 0.0;              ///< of the coupling in the step, either sign, J
  double friction_work = 0.0;     ///< the friction's part of it
  double sliding = 1.0;           ///< share of the displacement that is not along the normal, 0 to 1
  double step_fraction = 0.1;
  double share_of_work = 5e-4;  ///< SimulationSettings::work_tolerance
};
double allowedError(const StepTolerance& tolerance);

/// An upper estimate of the energy, joules, that a coupling has gained or lost in a step by: what the linear
/// model has missed, the trapezoidal rule's error in swinging and decaying, and the damping of what the step
/// does not resolve.
double errorOf(const Coupling& coupling, double step);

}  // namespace concave_distance::detail
