#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "simulation_state.h"

namespace concave_distance {
namespace {

using detail::Coupling;
using detail::MovingBody;

// Far below every time scale of a rigid body: steps that get this small have nowhere to go.
constexpr double kVanishingStep = 1e-15;
// Sums of steps miss the time of an event by rounding: this near, relative to the time, it is reached.
constexpr double kSameTime = 1e-13;
// The share of the allowed displacement, or error, that a repeated step aims at.
constexpr double kAim = 0.9;
// The error of a step goes with the third power of its size.
constexpr double kOrder = 3.0;
constexpr double kLargestGrowth = 2.0;
constexpr double kSmallestShare = 0.1;
constexpr double kLargestShare = 0.7;
// A force that jumps looks the same in steps of any size: this share of the steps that a swing takes
// is the smallest.
constexpr double kSmallestPart = 0.02;

bool isSameTime(double time, double event) {
  return std::isfinite(event) && event - time <= kSameTime * std::max(1.0, std::abs(event));
}

double factorFor(double error_share) {
  return kAim * std::pow(error_share, -1.0 / kOrder);
}

}  // namespace

double Simulation::State::solveSeconds() const {
  const auto seconds_of = [&](SimulationStage stage) {
    return counters.seconds[static_cast<std::size_t>(stage)];
  };
  return seconds_of(SimulationStage::Solve) + seconds_of(SimulationStage::Effects) +
         seconds_of(SimulationStage::Single);
}

// Kick and drift, and again with less if that went too far: nothing has been evaluated yet.
bool Simulation::State::moveWithin(double& step, StepLimit& limit) {
  while (step > kVanishingStep) {
    predict(step);
    drift(step);
    const double share = shareOfDisplacement();
    if (share <= 1.0) return true;
    for (MovingBody& body : moving) {
      if (body.isFree()) body.restore();
    }
    ++counters.shortened;
    limit = StepLimit::Distance;
    step *= std::isfinite(share) ? kAim / share : 0.0;
  }
  status = SimulationStatus::Diverged;
  return false;
}

void Simulation::State::proposeStep(double step, double error_share, StepLimit limit) {
  bool acts = false;
  bool changed = false;
  for (const Coupling& coupling : couplings) {
    acts = acts || coupling.force.acts;
    changed = changed || coupling.force.acts != coupling.begin.acts;
  }
  const double factor = std::min(kLargestGrowth, factorFor(error_share));
  if (!acts) {
    proposed_step = std::numeric_limits<double>::infinity();
  } else if (changed || factor < 1.0 || limit == StepLimit::Accuracy) {
    proposed_step = factor * step;
  } else {
    proposed_step = std::max(proposed_step, factor * step);
  }
}

void Simulation::State::finishStep(double step, double inside) {
  correct(step);
  bool finite = true;
  for (std::size_t i = 0; i < moving.size(); ++i) {
    const MovingBody& body = moving[i];
    if (!body.isFree()) continue;
    counters.largest_quaternion_drift =
        std::max(counters.largest_quaternion_drift, std::abs(drifts[i].norm_drift));
    finite = finite && body.state().velocity.allFinite() && body.state().angular_momentum.allFinite();
  }
  if (!finite) status = SimulationStatus::Diverged;
  addWorks(step);
  report(inside);
  sumEnergies();
}

void Simulation::State::countStep(double step, StepLimit limit) {
  ++counters.steps;
  ++counters.limited_by[static_cast<std::size_t>(limit)];
  if (limit != StepLimit::Event) counters.smallest_step = std::min(counters.smallest_step, step);
  if (limit == StepLimit::Distance) ++pairs[holds_distance].held_back_by_distance;
  if (limit != StepLimit::Accuracy) return;
  if (holds_accuracy < pairs.size()) {
    ++pairs[holds_accuracy].held_back_by_accuracy;
  } else {
    ++bodies[couplings[holds_accuracy].body_b].held_back_by_drive;
  }
}

double Simulation::State::step(double until) {
  if (status != SimulationStatus::Ok || !(until > time)) return 0.0;
  const auto start = std::chrono::steady_clock::now();
  const double elsewhere = solveSeconds();
  double event = nextEvent(until);
  while (isSameTime(time, event)) {
    time = event;
    if (!(until > time)) return 0.0;
    event = nextEvent(until);
  }
  const double soon = time + 0.5 * std::min(settings.largest_step, event - time);
  beginStep(soon);
  StepLimit limit = StepLimit::Largest;
  double step = limitStep(event, limit);
  double error_share = 0.0;
  while (true) {
    if (!moveWithin(step, limit)) return 0.0;
    const double end = time_at_begin + step;
    time = limit == StepLimit::Event || isSameTime(end, event) ? event : end;
    for (detail::PairRunner& runner : runners) runner.wantNiches(std::isinf(until) || time == until);
    evaluateEnd(step, soon);
    error_share = shareOfError(step);
    if (error_share <= 1.0) break;
    double fastest = 0.0;
    for (const Coupling& coupling : couplings) fastest = std::max(fastest, coupling.stiffness_rate);
    if (step * std::sqrt(fastest) < kSmallestPart * settings.step_fraction && fastest > 0.0) break;
    restore(soon);
    ++counters.rejected;
    limit = StepLimit::Accuracy;
    holds_accuracy = least_accurate;
    step *= std::clamp(factorFor(error_share), kSmallestShare, kLargestShare);
  }
  countStep(step, limit);
  proposeStep(step, error_share, limit);
  holds_accuracy = least_accurate;
  finishStep(step, soon);
  counters.seconds[static_cast<std::size_t>(SimulationStage::Integration)] +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() -
      (solveSeconds() - elsewhere);
  return step;
}

}  // namespace concave_distance
