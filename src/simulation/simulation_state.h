#pragma once

#include <limits>
#include <string>
#include <vector>

#include "concave_distance/simulation/simulation.h"
#include "coupling.h"
#include "moving_body.h"
#include "pair_runner.h"
#include "step_equations.h"
#include "step_error.h"

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

// Holds what the works of a step need from its begin.
struct StepBegin {
  BodyContacts contacts;
  Wrench load;
  double drive_power = 0.0;
  double drive_loss = 0.0;
};

// Holds what limits a pair's steps, from the begin of the step.
struct PairBegin {
  double lower_bound = 0.0;  ///< metres
  double allowance = 0.0;    ///< beyond it, metres
  double depth = 0.0;        ///< of the deepest region, metres

  /// Returns how far any point may move against the other body. What is apart comes near first,
  /// and touches then.
  double allowed() const { return lower_bound > allowance ? lower_bound : lower_bound + allowance; }
};

}  // namespace detail

/// Everything of a simulation: bodies with what acts on them, pairs, and what they came to at `time`.
struct Simulation::State {
  State(const Scene& scene, const SimulationSettings& given);

  // simulation_state.cpp: the parts, and what is reported of them.
  void warn(const std::vector<std::string>& more);
  void addBodies(const Scene& scene);
  void addPairs(const Scene& scene);
  void addDrives();
  void evaluateContacts(double step);
  void evaluateDrives(double inside);
  void report(double inside);
  void addWorks(double step);
  void sumEnergies();

  // step_limits.cpp: how far a step may go before it is tried.
  double nextEvent(double until) const;
  double limitStep(double event, StepLimit& limit);
  void allowDisplacements();
  double speedBetween(const SimulatedPair& pair) const;
  /// The largest share of its allowed displacement that a pair has moved.
  double shareOfDisplacement();

  // step_attempt.cpp: one step of a given size, tried.
  void beginStep(double inside);
  void setJacobians();
  void setMotions(double inside);
  void findLoads();
  Vector6d wrenchOn(std::size_t body) const;
  void drift(double step);
  void findChange(detail::Coupling& coupling, double step) const;
  void evaluateEnd(double step, double inside);
  void restore(double inside);
  Vector6d sumOn(std::size_t body, const Vector6d detail::Coupling::*wrench) const;

  // step_rule.cpp: the impulses of a step, by the couplings' linear models.
  bool leavesUnresolved(double step, const detail::CouplingForce detail::Coupling::*when) const;
  void setSteady(double seconds);
  void findChanges(double step, const detail::CouplingForce detail::Coupling::*when);
  void keepUnresolved(double step, const detail::CouplingForce detail::Coupling::*when);
  void respond(double step, double end_weight);
  void predict(double step);
  void respondToMissed(double step, double end_weight);
  void correct(double step);

  // step_acceptance.cpp: how good the step was.
  /// Returns how many times the tolerance the step's error is.
  double shareOfError(double step);
  detail::StepTolerance toleranceOf(std::size_t coupling) const;
  double energyOfMotion(const detail::Coupling& coupling) const;

  // simulation_step.cpp: the step that is taken.
  double step(double until);
  bool moveWithin(double& step, StepLimit& limit);
  void proposeStep(double step, double error_share, StepLimit limit);
  void finishStep(double step, double inside);
  void countStep(double step, StepLimit limit);
  double solveSeconds() const;

  SimulationSettings settings;
  double time = 0.0;
  SimulationStatus status = SimulationStatus::Ok;
  std::vector<detail::MovingBody> moving;
  std::vector<detail::PairRunner> runners;
  std::vector<SimulatedBody> bodies;
  std::vector<SimulatedPair> pairs;
  std::vector<detail::BodyContacts> contacts;
  std::vector<Wrench> external;
  EnergyAccount energy;
  SimulationCounters counters;
  std::vector<std::string> warnings;

  // These belong to the step, by body, by pair and by coupling: first those of the pairs, in their order,
  // then the drives.
  std::vector<detail::StepBegin> begins;
  std::vector<Drift> drifts;
  std::vector<detail::FrameMotion> motions;
  std::vector<detail::StepEquations::Inertia> inertias;
  std::vector<Vector6d> left_of_begin;  ///< impulse at the begin that the end still owes, by body
  std::vector<Vector6d> impulses;
  std::vector<Vector6d> changes;
  std::vector<detail::PairBegin> pair_begins;
  std::vector<detail::Coupling> couplings;
  detail::StepEquations equations;
  bool unresolved = false;  ///< the step is longer than a time scale
  double time_at_begin = 0.0;
  double proposed_step = std::numeric_limits<double>::infinity();  ///< by the error of the last one
  std::size_t least_accurate = 0;  ///< coupling with the largest share of its error in the last attempt
  std::size_t holds_accuracy = 0;  ///< coupling whose error has shortened the step
  std::size_t holds_distance = 0;  ///< pair whose distance has shortened the step
};

}  // namespace concave_distance
