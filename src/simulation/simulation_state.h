#pragma once

#include <vector>

#include "concave_distance/simulation/simulation.h"
#include "moving_body.h"
#include "pair_runner.h"

namespace concave_distance {
namespace detail {

// Wrenches on a body about its centre.
struct BodyContacts {
  Wrench normal;
  Wrench friction;
  Wrench sum() const {
    Wrench total = normal;
    total += friction;
    return total;
  }
};

// What the works of a step need from its begin.
struct StepBegin {
  BodyContacts contacts;
  Wrench load;
  double drive_power = 0.0;
  double drive_loss = 0.0;
};

}  // namespace detail

/// Everything of a simulation: bodies with what acts on them, pairs, and what they came to at `time`.
struct Simulation::State {
  State(const Scene& scene, const SimulationSettings& given);

  double nextEvent(double until) const;
  double limitStep(double event, StepLimit& limit);
  detail::ContactSpeeds speedsOf(std::size_t index, double step) const;
  double allowedDisplacement(const SimulatedPair& pair) const {
    return pair.lower_bound + settings.allowed_penetration;
  }
  /// The largest share of its allowed way that a pair has gone.
  double shareOfDisplacement() const;
  void evaluateContacts(double step);
  void report(double inside);
  void addWorks(double step);
  void sumEnergies();
  double step(double until);

  SimulationSettings settings;
  double time = 0.0;
  SimulationStatus status = SimulationStatus::Ok;
  std::vector<detail::MovingBody> moving;
  std::vector<detail::PairRunner> runners;
  std::vector<SimulatedBody> bodies;
  std::vector<SimulatedPair> pairs;
  std::vector<detail::BodyContacts> contacts;
  std::vector<detail::StepBegin> begins;
  std::vector<Drift> drifts;
  std::vector<Wrench> external;
  std::vector<detail::ContactSpeeds> speeds;  ///< of each body's contacts, for limitStep
  EnergyAccount energy;
  SimulationCounters counters;
};

}  // namespace concave_distance
