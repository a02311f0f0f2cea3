#include "step_error.h"

#include <algorithm>
#include <cmath>

#include "base/across_normal.h"

namespace concave_distance::detail {
namespace {

// A body that swings within the depth that its load presses it to is at rest up to this share of the energy
// there and of a lift by its size; one that sticks by friction, up to a motion by this share.
constexpr double kShareOfDepth = 1e-4;
constexpr double kShareOfSize = 1e-6;
constexpr double kShareOfSizeAcross = 1e-8;
// Friction may be in error by that much more of its work, because its sites come and go.
constexpr double kFrictionsShare = 5.0;

}  // namespace

double shareAcross(const Vector6d& displacement, const Eigen::Vector3d& point,
                   const Eigen::Vector3d& normal) {
  const Eigen::Vector3d shift = displacement.head<3>() + Eigen::Vector3d(displacement.tail<3>()).cross(point);
  const double length = shift.norm();
  return length > 0.0 ? acrossNormal(normal, shift).norm() / length : 0.0;
}

double allowedError(const StepTolerance& tolerance) {
  const double fraction = tolerance.step_fraction;
  const double share_of_size = kShareOfSize + tolerance.sliding * (kShareOfSizeAcross - kShareOfSize);
  // The trapezoidal rule misses E (w h)^3 / 6 of a swing of energy E in a step.
  return fraction * fraction * fraction / 6.0 * tolerance.energy_of_motion +
         tolerance.share_of_work *
             (std::abs(tolerance.work) + kFrictionsShare * std::abs(tolerance.friction_work)) +
         tolerance.load * (kShareOfDepth * tolerance.depth + share_of_size * tolerance.size);
}

double errorOf(const Coupling& coupling, double step) {
  const Vector6d& displacement = coupling.displacement;
  const ContactLinearisation& now = coupling.begin.linearisation;
  const double missed = 0.5 * std::abs(coupling.residual.dot(displacement));
  const double stretched = displacement.dot(now.stiffness * displacement);
  const double swing = std::min(1.0, step * std::sqrt(coupling.stiffness_rate)) / 12.0;
  const double slowed = std::abs(coupling.full_change.dot(now.damping * displacement));
  const double decay = std::min(1.0, step * coupling.damping_rate) / 12.0;
  return missed + swing * stretched + decay * slowed + coupling.loss;
}

}  // namespace concave_distance::detail
