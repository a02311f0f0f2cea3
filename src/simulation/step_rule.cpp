// Computes what the couplings do in a step, by their linear models. The trapezoidal rule keeps the energy of
// what the step resolves; a rule that counts the end of the step by more than a half damps. What the step
// does not resolve, and that alone, goes by the second one: of the difference between the two rules the
// equations let through, in each direction in which the bodies can move together, the share (x / (1 + x))^2
// of a direction of which the step is x = h^2 k / m + h d / m time scales long.
#include "simulation_state.h"

namespace concave_distance {

using detail::Coupling;
using detail::CouplingForce;

namespace {

// Weights of the end of the step. What is damped keeps (1 - w) / w of itself from step to step.
constexpr double kTrapezoidal = 0.5;
constexpr double kDamping = 0.75;
// Steps longer in sum than that many time scales of a coupling leave something unresolved.
constexpr double kResolved = 1.0;

Matrix6d resistanceOf(const ContactLinearisation& linearisation, double step) {
  return step * (step * linearisation.stiffness + linearisation.damping);
}

}  // namespace

bool Simulation::State::leavesUnresolved(double step, const CouplingForce Coupling::*when) const {
  for (const Coupling& coupling : couplings) {
    if (!(coupling.*when).acts) continue;
    const Matrix6d resistance = resistanceOf((coupling.*when).linearisation, step);
    if (detail::sumOfScales(resistance, coupling, inertias) > kResolved) return true;
  }
  return false;
}

// Gravity and loads over that many seconds.
void Simulation::State::setSteady(double seconds) {
  for (std::size_t i = 0; i < moving.size(); ++i) {
    impulses[i].setZero();
    if (!moving[i].isFree()) continue;
    const Wrench steady = moving[i].steadyWrench(settings.gravity);
    impulses[i] << seconds * steady.force, seconds * steady.torque;
  }
}

// Finds what changes under the impulses of the bodies and of the couplings, against the couplings' resistance
// over `step`. Those of the bodies are used up.
void Simulation::State::findChanges(double step, const CouplingForce Coupling::*when) {
  for (std::size_t i = 0; i < moving.size(); ++i) impulses[i] += sumOn(i, &Coupling::impulse);
  for (Coupling& coupling : couplings) {
    coupling.resistance.setZero();
    if (coupling.begin.acts) coupling.resistance = resistanceOf((coupling.*when).linearisation, step);
  }
  equations.solve(inertias, impulses, couplings, changes);
  for (Vector6d& impulse : impulses) impulse.setZero();
}

// Keeps the impulses of couplings and bodies that the step does not resolve, as impulses of the couplings.
void Simulation::State::keepUnresolved(double step, const CouplingForce Coupling::*when) {
  for (int pass = 0; pass < 2; ++pass) {
    findChanges(step, when);
    for (Coupling& coupling : couplings) coupling.impulse = coupling.resistance * coupling.change;
  }
}

// The mean wrenches w - p K d - p D dV of M dV = h (w - p K d - p D dV), p the weight of the step's end, with
// the displacement d = h (V + p dV). The equations are solved for p dV.
void Simulation::State::respond(double step, double end_weight) {
  const double late = end_weight * step;
  for (Coupling& coupling : couplings) {
    coupling.used.setZero();
    coupling.resistance.setZero();
    if (!coupling.begin.acts) continue;
    const ContactLinearisation& now = coupling.begin.linearisation;
    const Matrix6d stiffness = end_weight * now.stiffness;
    coupling.resistance = late * (step * stiffness + now.damping);
    coupling.used = coupling.begin.wrench - step * (stiffness * coupling.twist);
  }
  for (std::size_t i = 0; i < moving.size(); ++i) {
    if (moving[i].isFree()) impulses[i] = late * wrenchOn(i);
  }
  equations.solve(inertias, impulses, couplings, changes);
  for (Coupling& coupling : couplings) coupling.used -= coupling.resistance * coupling.change / late;
}

void Simulation::State::predict(double step) {
  respond(step, kTrapezoidal);
  unresolved = leavesUnresolved(step, &Coupling::begin);
  if (!unresolved) return;
  for (Coupling& coupling : couplings) coupling.undamped = coupling.used;
  respond(step, kDamping);
  for (Coupling& coupling : couplings) {
    coupling.impulse = step * (kDamping * coupling.used - kTrapezoidal * coupling.undamped);
  }
  setSteady((kDamping - kTrapezoidal) * step);
  keepUnresolved(step, &Coupling::begin);
  for (Coupling& coupling : couplings) {
    coupling.first = kTrapezoidal * step * coupling.undamped + coupling.impulse;
    coupling.impulse = step * (coupling.used - coupling.undamped);
  }
  keepUnresolved(step, &Coupling::begin);
  for (Coupling& coupling : couplings) coupling.used = coupling.undamped + coupling.impulse / step;
}

// Impulses of what the linear model has missed of the wrench at the end, against the resistance there.
void Simulation::State::respondToMissed(double step, double end_weight) {
  for (Coupling& coupling : couplings) coupling.impulse = end_weight * step * coupling.residual;
  for (Vector6d& impulse : impulses) impulse.setZero();
  findChanges(end_weight * step, &Coupling::force);
  for (Coupling& coupling : couplings) coupling.impulse -= coupling.resistance * coupling.change;
}

void Simulation::State::correct(double step) {
  for (std::size_t i = 0; i < moving.size(); ++i) inertias[i] = moving[i].inertia();
  for (Coupling& coupling : couplings) coupling.begin.acts = coupling.begin.acts || coupling.force.acts;
  equations.findIslands(inertias, couplings);
  respondToMissed(step, kTrapezoidal);
  if (unresolved || leavesUnresolved(step, &Coupling::force)) {
    for (Coupling& coupling : couplings) coupling.used = coupling.impulse;
    respondToMissed(step, kDamping);
    for (Coupling& coupling : couplings) coupling.impulse -= coupling.used;
    keepUnresolved(step, &Coupling::force);
    for (Coupling& coupling : couplings) coupling.impulse += coupling.used;
  }
  for (std::size_t i = 0; i < moving.size(); ++i) {
    if (moving[i].isFree()) moving[i].kick(detail::toWrench(sumOn(i, &Coupling::impulse)), 1.0);
  }
}

}  // namespace concave_distance
