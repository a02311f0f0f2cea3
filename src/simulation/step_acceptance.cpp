#include <algorithm>
#include <limits>

#include "simulation_state.h"
#include "step_error.h"

namespace concave_distance {
namespace {

using detail::Coupling;
using detail::FrameMotion;
using detail::MovingBody;

// The tolerance for what a contact does along its normal has this share of the energy of sliding.
constexpr double kShareOfSliding = 0.02;

double freeMassOf(const std::vector<MovingBody>& bodies, std::size_t body) {
  return body != detail::kNoBody && bodies[body].isFree() ? bodies[body].rigid().mass()
                                                          : std::numeric_limits<double>::infinity();
}

// At the begin or the end of the step, whichever is faster.
double speedAlongNormal(const Coupling& coupling, const ContactRegion& region) {
  const auto speed = [&](const Vector6d& twist) {
    const RelativeTwist motion{twist.head<3>(), twist.tail<3>()};
    return std::abs(motion.at(region.point_in_a).dot(region.overlap.normal_in_a));
  };
  return std::max(speed(coupling.twist), speed(coupling.twist + coupling.full_change));
}

// At the end of the step, over its displacement.
double frictionWork(const std::vector<ContactRegion>& regions, const Vector6d& displacement) {
  Vector6d sum = Vector6d::Zero();
  for (const ContactRegion& region : regions) {
    const Wrench& wrench = region.rubbing_on_b_in_a;
    if (!wrench.force.allFinite()) continue;
    sum.head<3>() += wrench.force;
    sum.tail<3>() += wrench.torque;
  }
  return sum.dot(displacement);
}

}  // namespace

// Returns the energy with which the lighter body moves against the other.
double Simulation::State::energyOfMotion(const Coupling& coupling) const {
  const bool b_is_lighter = freeMassOf(moving, coupling.body_b) <= freeMassOf(moving, coupling.body_a);
  const std::size_t lighter = b_is_lighter ? coupling.body_b : coupling.body_a;
  const std::size_t other = b_is_lighter ? coupling.body_a : coupling.body_b;
  if (std::isinf(freeMassOf(moving, lighter))) return 0.0;
  FrameMotion against;
  if (other != detail::kNoBody) {
    against = motions[other];
  } else {
    against = moving[lighter].targetMotion(time, time);
  }
  const FrameMotion& body = motions[lighter];
  const Eigen::Vector3d velocity = body.velocityAt(body.centre) - against.velocityAt(body.centre);
  const Eigen::Vector3d spin = (body.twist - against.twist).tail<3>();
  return 0.5 * (inertias[lighter].mass * velocity.squaredNorm() + spin.dot(inertias[lighter].inertia * spin));
}

// A contact swings with the motion along its normal, however fast the bodies slide.
detail::StepTolerance Simulation::State::toleranceOf(std::size_t index) const {
  const Coupling& coupling = couplings[index];
  detail::StepTolerance tolerance;
  tolerance.step_fraction = settings.step_fraction;
  tolerance.share_of_work = settings.work_tolerance;
  tolerance.energy_of_motion = energyOfMotion(coupling);
  tolerance.load = coupling.load;
  tolerance.work = 0.5 * (coupling.begin.wrench + coupling.force.wrench).dot(coupling.displacement);
  if (index >= pairs.size()) {
    tolerance.depth = moving[coupling.body_b].driveStretch();
    tolerance.size = moving[coupling.body_b].radius();
    return tolerance;
  }
  const std::vector<ContactRegion>& regions = pairs[index].contacts.regions;
  tolerance.depth = pair_begins[index].depth;
  tolerance.size = std::min(moving[coupling.body_a].radius(), moving[coupling.body_b].radius());
  if (regions.empty()) return tolerance;
  tolerance.friction_work = frictionWork(regions, coupling.displacement);
  const ContactRegion& deepest = regions.front();
  tolerance.depth = std::max(tolerance.depth, deepest.overlap.depth);
  tolerance.sliding =
      detail::shareAcross(coupling.displacement, deepest.point_in_a, deepest.overlap.normal_in_a);
  const double speed = speedAlongNormal(coupling, deepest);
  const double mass = std::min(freeMassOf(moving, coupling.body_a), freeMassOf(moving, coupling.body_b));
  const double all = tolerance.energy_of_motion;
  const double along = std::min(all, 0.5 * mass * speed * speed);
  tolerance.energy_of_motion = along + kShareOfSliding * (all - along);
  return tolerance;
}

double Simulation::State::shareOfError(double step) {
  double largest = 0.0;
  for (std::size_t i = 0; i < couplings.size(); ++i) {
    if (!couplings[i].begin.acts && !couplings[i].force.acts) continue;
    const double error = detail::errorOf(couplings[i], step);
    const double share = error > 0.0 ? error / detail::allowedError(toleranceOf(i)) : 0.0;
    if (!(share > largest)) continue;
    largest = share;
    least_accurate = i;
  }
  return largest;
}

}  // namespace concave_distance
