#include "step_error.h"

#include <algorithm>
#include <cmath>

namespace concave_distance::detail {
namespace {

// A body at rest swings by a tenth of its depth at most before that is resolved: a hundredth of its energy.
constexpr double kShareAtRest = 0.01;

}  // namespace

double allowedError(const StepTolerance& tolerance) {
  const double fraction = tolerance.step_fraction;
  // Of a swing of energy E the trapezoidal rule misses E (w h)^3 / 6 in a step.
  return fraction * fraction * fraction / 6.0 * tolerance.energy_of_motion +
         kShareAtRest * tolerance.energy_at_rest;
}

double errorOf(const Coupling& coupling, double step) {
  const Vector6d& displacement = coupling.displacement;
  const ContactLinearisation& now = coupling.begin.linearisation;
  const double missed = 0.5 * std::abs(coupling.residual.dot(displacement));
  const double stretched = displacement.dot(now.stiffness * displacement);
  const double swing = std::min(1.0, step * std::sqrt(coupling.stiffness_rate)) / 12.0;
  // The displacement is step times the mean twist, and `change` half of the twist's.
  const double slowed = 2.0 * std::abs(coupling.change.dot(now.damping * displacement));
  const double decay = std::min(1.0, step * coupling.damping_rate) / 12.0;
  return missed + (swing + coupling.forward_stiffness - 0.5) * stretched +
         (decay + coupling.forward_damping - 0.5) * slowed;
}

}  // namespace concave_distance::detail
