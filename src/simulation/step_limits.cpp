#include <algorithm>
#include <limits>

#include "simulation_state.h"

namespace concave_distance {
namespace {

using detail::MovingBody;
using detail::PairBegin;

// Shares of the depth that the next contact is expected to reach. What can stop a body is thicker than that
// depth, so that nothing is passed through; the begin of a contact decides about its energy.
constexpr double kShareInContact = 1.0;
constexpr double kShareAtBegin = 0.02;
// Places are rounded: this far, relative to the body's size, it may always move.
constexpr double kRoundedPlace = 1e-9;
// A step takes this share of the way allowed at the present speed, which changes a little within the step.
constexpr double kShareOfAllowed = 0.99;

double reducedMass(const MovingBody& a, const MovingBody& b) {
  if (!a.isFree()) return b.rigid().mass();
  if (!b.isFree()) return a.rigid().mass();
  return a.rigid().mass() * b.rigid().mass() / (a.rigid().mass() + b.rigid().mass());
}

}  // namespace

double Simulation::State::nextEvent(double until) const {
  double event = until;
  for (const MovingBody& body : moving) event = std::min(event, body.nextEvent(time));
  return event;
}

double Simulation::State::speedBetween(const SimulatedPair& pair) const {
  const detail::FrameMotion& a = motions[pair.body_a];
  const detail::FrameMotion& b = motions[pair.body_b];
  return (b.twist - a.twist).head<3>().norm() + moving[pair.body_a].radius() * a.twist.tail<3>().norm() +
         moving[pair.body_b].radius() * b.twist.tail<3>().norm();
}

void Simulation::State::allowDisplacements() {
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const SimulatedPair& pair = pairs[i];
    const MovingBody& a = moving[pair.body_a];
    const MovingBody& b = moving[pair.body_b];
    PairBegin& begin = pair_begins[i];
    begin.lower_bound = pair.lower_bound;
    begin.depth = pair.contacts.regions.empty() ? 0.0 : pair.contacts.regions.front().overlap.depth;
    if (!runners[i].hasForces() || !(a.isFree() || b.isFree())) {
      begin.allowance = std::numeric_limits<double>::infinity();
      continue;
    }
    const double size = std::min(a.radius(), b.radius());
    const ContactLoad load{reducedMass(a, b), speedBetween(pair), couplings[i].load};
    const double depth = runners[i].expectedDepth(load, size) + kRoundedPlace * size;
    const bool acts = couplings[i].begin.acts;
    const double expected = (acts ? kShareInContact : kShareAtBegin) * depth;
    const double given = settings.allowed_penetration;
    begin.allowance = given > 0.0 && (acts || given < expected) ? given : expected;
  }
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
  hold(proposed_step, StepLimit::Accuracy);
  for (std::size_t i = 0; i < moving.size(); ++i) {
    if (moving[i].isFree()) {
      hold(settings.step_fraction / motions[i].twist.tail<3>().norm(), StepLimit::Rotation);
    }
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double before = step;
    hold(kShareOfAllowed * pair_begins[i].allowed() / speedBetween(pairs[i]), StepLimit::Distance);
    if (step < before) holds_distance = i;
  }
  return step;
}

double Simulation::State::shareOfDisplacement() {
  double largest = 0.0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Drift& a = drifts[pairs[i].body_a];
    const Drift& b = drifts[pairs[i].body_b];
    const double displacement = (b.shift - a.shift).norm() + moving[pairs[i].body_a].radius() * a.turn +
                                moving[pairs[i].body_b].radius() * b.turn;
    const double share = displacement / pair_begins[i].allowed();
    if (!(share > largest)) continue;
    largest = share;
    if (share > 1.0) holds_distance = i;
  }
  return largest;
}

}  // namespace concave_distance
