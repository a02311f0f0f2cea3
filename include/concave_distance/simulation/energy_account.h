#pragma once

#include <cmath>

namespace concave_distance {

/// Says where the energy of the free bodies is, where it came from and where it went, joules. Works are
/// integrals over the path (trapezoidal rule), apart from the impulses that move the bodies: what they leave
/// unexplained is the integration error.
struct EnergyAccount {
  double kinetic = 0.0;
  double gravity_potential = 0.0;  ///< 0 with the centre of mass at the origin
  double drive_potential = 0.0;    ///< in the springs of the drives
  double initial = 0.0;            ///< mechanical() at the start

  // These works were done on the free bodies since the start.
  double normal_work = 0.0;    ///< of contact forces along the normal; < 0: lost, or still in a contact
  double friction_work = 0.0;  ///< of friction, against rolling and spinning too
  double load_work = 0.0;      ///< of applied loads
  double drive_work = 0.0;     ///< of moving the drives' targets
  double drive_loss = 0.0;     ///< taken by the drives' dampers, >= 0

  double largest_kinetic = 0.0;  ///< so far
  double negligible = 0.0;       ///< what lifts every free body by a hundredth of its radius

  double mechanical() const { return kinetic + gravity_potential + drive_potential; }
  double work() const { return normal_work + friction_work + load_work + drive_work - drive_loss; }
  /// Returns the energy that is there though nothing put it in: the error of the integration, of either sign.
  double balanceError() const { return mechanical() - initial - work(); }
  /// Returns what went through the system: the most that moved at once, and all works.
  double throughput() const {
    return largest_kinetic + std::abs(normal_work) + std::abs(friction_work) + std::abs(load_work) +
           std::abs(drive_work) + drive_loss;
  }
  /// The error of the integration as a share of throughput(), >= 0; negligible energies apart.
  double balanceShare() const {
    const double error = std::abs(balanceError());
    return error > 0.0 ? error / (throughput() + negligible) : 0.0;
  }
};

}  // namespace concave_distance
