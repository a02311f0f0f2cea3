#include <algorithm>
#include <chrono>
#include <cmath>

#include "simulation_state.h"

namespace concave_distance {
namespace {

using detail::ContactSpeeds;
using detail::MovingBody;

// Explicit damping decays without swinging over up to 1 / rate, and is stable up to twice that.
constexpr double kDampingFraction = 0.5;
// Far below every time scale of a rigid body: steps that get this small have nowhere to go.
constexpr double kVanishingStep = 1e-15;
// Sums of steps miss the time of an event by rounding: this near, relative to the time, it is reached.
constexpr double kSameTime = 1e-13;
// The share of the allowed way that a repeated drift aims at.
constexpr double kAim = 0.9;

}  // namespace

ContactSpeeds Simulation::State::speedsOf(std::size_t index, double step) const {
  const SimulatedPair& pair = pairs[index];
  struct Compliance {
    const MovingBody& a;
    const MovingBody& b;
    double along(const Eigen::Vector3d& point, const Eigen::Vector3d& direction) const {
      return (a.isFree() ? a.rigid().compliance(a.state(), point, direction) : 0.0) +
             (b.isFree() ? b.rigid().compliance(b.state(), point, direction) : 0.0);
    }
    double largest(const Eigen::Vector3d& point) const {
      return (a.isFree() ? a.rigid().largestCompliance(a.state(), point) : 0.0) +
             (b.isFree() ? b.rigid().largestCompliance(b.state(), point) : 0.0);
    }
  };
  return runners[index].speeds(pair, bodies[pair.body_a].world_from_body, step,
                               Compliance{moving[pair.body_a], moving[pair.body_b]});
}

double Simulation::State::nextEvent(double until) const {
  double event = until;
  for (const MovingBody& body : moving) event = std::min(event, body.nextEvent(time));
  return event;
}

double Simulation::State::limitStep(double event, StepLimit& limit) {
  double step = settings.largest_step;
  limit = StepLimit::Largest;
  const auto hold = [&](double other, StepLimit by) {
    if (!(other < step)) return;
    step = other;
    limit = by;
  };
  hold(event - time, StepLimit::Event);
  const double inside = time + 0.5 * step;
  for (const MovingBody& body : moving) {
    if (body.isFree()) hold(settings.step_fraction / body.angularSpeed(inside), StepLimit::Rotation);
  }
  for (const SimulatedPair& pair : pairs) {
    const MovingBody& a = moving[pair.body_a];
    const MovingBody& b = moving[pair.body_b];
    const double speed = (b.referenceVelocity(inside) - a.referenceVelocity(inside)).norm() +
                         a.spinSpeed(inside) + b.spinSpeed(inside);
    hold(allowedDisplacement(pair) / speed, StepLimit::Distance);
  }
  // Every contact and drive of a body adds to what resists its motion.
  std::fill(speeds.begin(), speeds.end(), ContactSpeeds());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const ContactSpeeds pair = speedsOf(i, step);
    for (const std::size_t body : {pairs[i].body_a, pairs[i].body_b}) {
      speeds[body].stiffness_rate += pair.stiffness_rate;
      speeds[body].damping_rate += pair.damping_rate;
    }
  }
  for (std::size_t i = 0; i < moving.size(); ++i) {
    if (!moving[i].isFree()) continue;
    const double stiffness = speeds[i].stiffness_rate + moving[i].driveStiffnessRate();
    const double damping = speeds[i].damping_rate + moving[i].driveDampingRate();
    hold(settings.step_fraction / std::sqrt(stiffness), StepLimit::Stiffness);
    hold(kDampingFraction / damping, StepLimit::Damping);
  }
  return step;
}

double Simulation::State::shareOfDisplacement() const {
  double share = 0.0;
  for (const SimulatedPair& pair : pairs) {
    const Drift& a = drifts[pair.body_a];
    const Drift& b = drifts[pair.body_b];
    const double displacement = (b.shift - a.shift).norm() + moving[pair.body_a].radius() * a.turn +
                                moving[pair.body_b].radius() * b.turn;
    share = std::max(share, displacement / allowedDisplacement(pair));
  }
  return share;
}

double Simulation::State::step(double until) {
  if (status != SimulationStatus::Ok || !(until > time)) return 0.0;
  const auto start = std::chrono::steady_clock::now();
  const auto seconds_of = [&](SimulationStage stage) {
    return counters.seconds[static_cast<std::size_t>(stage)];
  };
  const double elsewhere = seconds_of(SimulationStage::Solve) + seconds_of(SimulationStage::Effects) +
                           seconds_of(SimulationStage::Single);
  double event = nextEvent(until);
  while (std::isfinite(event) && event - time <= kSameTime * std::max(1.0, std::abs(event))) {
    time = event;
    if (!(until > time)) return 0.0;
    event = nextEvent(until);
  }
  StepLimit limit = StepLimit::Largest;
  double step = limitStep(event, limit);
  // Kick and drift, and again with less if that went too far: nothing has been evaluated yet.
  while (true) {
    if (!(step > kVanishingStep)) {
      status = SimulationStatus::Diverged;
      return 0.0;
    }
    const double inside = time + 0.5 * step;
    for (std::size_t i = 0; i < moving.size(); ++i) {
      MovingBody& body = moving[i];
      if (body.isFree()) {
        body.evaluateExternal(time, inside, body.state(), external[i]);
        begins[i] = {contacts[i], body.load(), body.drive().power, body.drive().loss};
      }
      drifts[i] = body.advance(time, step, contacts[i].sum(), settings.gravity);
    }
    const double share = shareOfDisplacement();
    if (share <= 1.0) break;
    for (MovingBody& body : moving) body.restore();
    ++counters.shortened;
    limit = StepLimit::Distance;
    step *= std::isfinite(share) ? kAim / share : 0.0;
  }
  const double inside = time + 0.5 * step;
  const bool at_event = limit == StepLimit::Event;
  time = at_event ? event : time + step;  // exactly at an event, whatever the sum rounds to
  // Forces at the end of the step, with velocities extrapolated to it.
  for (std::size_t i = 0; i < moving.size(); ++i) {
    MovingBody& body = moving[i];
    body.report(time, inside, bodies[i]);
    if (!body.isFree()) continue;
    const RigidBodyState ahead = body.extrapolated(step, contacts[i].sum(), settings.gravity);
    bodies[i].velocity = ahead.velocity;
    bodies[i].angular_velocity = body.rigid().angularVelocity(ahead);
    body.evaluateExternal(time, inside, ahead, external[i]);
  }
  evaluateContacts(step);
  bool finite = true;
  for (std::size_t i = 0; i < moving.size(); ++i) {
    MovingBody& body = moving[i];
    if (!body.isFree()) continue;
    body.kick(contacts[i].sum(), settings.gravity, 0.5 * step);
    counters.largest_quaternion_drift =
        std::max(counters.largest_quaternion_drift, std::abs(drifts[i].norm_drift));
    finite = finite && body.state().velocity.allFinite() && body.state().angular_momentum.allFinite();
  }
  if (!finite) status = SimulationStatus::Diverged;
  addWorks(step);
  report(inside);
  sumEnergies();
  ++counters.steps;
  ++counters.limited_by[static_cast<std::size_t>(limit)];
  if (!at_event) counters.smallest_step = std::min(counters.smallest_step, step);
  const double solved = seconds_of(SimulationStage::Solve) + seconds_of(SimulationStage::Effects) +
                        seconds_of(SimulationStage::Single) - elsewhere;
  counters.seconds[static_cast<std::size_t>(SimulationStage::Integration)] +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() - solved;
  return step;
}

}  // namespace concave_distance
