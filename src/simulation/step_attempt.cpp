#include <algorithm>
#include <cmath>
#include <limits>

#include "simulation_state.h"

namespace concave_distance {
namespace {

using detail::Coupling;
using detail::CouplingForce;
using detail::FrameMotion;
using detail::MovingBody;
using detail::StepEquations;

// A bound on the eigenvalues of M^-1 J^T K J: its trace.
double rateOf(const Matrix6d& matrix, const Coupling& coupling,
              const std::vector<StepEquations::Inertia>& inertias) {
  double rate = 0.0;
  const auto add = [&](std::size_t body, const Matrix6d& jacobian) {
    if (body == detail::kNoBody || !(inertias[body].mass > 0.0)) return;
    const Matrix6d on_body = jacobian.transpose() * matrix * jacobian;
    rate += on_body.diagonal().head<3>().sum() / inertias[body].mass +
            (inertias[body].inertia.inverse() * on_body.bottomRightCorner<3, 3>()).trace();
  };
  add(coupling.body_a, coupling.jacobian_a);
  add(coupling.body_b, coupling.jacobian_b);
  return rate;
}

}  // namespace

void Simulation::State::setMotions(double inside) {
  for (std::size_t i = 0; i < moving.size(); ++i) motions[i] = moving[i].motionAt(time, inside);
}

void Simulation::State::setJacobians() {
  for (std::size_t i = 0; i < couplings.size(); ++i) {
    Coupling& coupling = couplings[i];
    const bool is_drive = coupling.body_a == detail::kNoBody;
    const Eigen::Isometry3d world_from_a =
        is_drive ? moving[coupling.body_b].targetPose(time) : bodies[coupling.body_a].world_from_body;
    coupling.jacobian_b = detail::jacobianAt(world_from_a, motions[coupling.body_b].centre);
    if (!is_drive) coupling.jacobian_a = -detail::jacobianAt(world_from_a, motions[coupling.body_a].centre);
  }
}

void Simulation::State::beginStep(double inside) {
  time_at_begin = time;
  setMotions(inside);
  setJacobians();
  evaluateDrives(inside);  // another piece of the path may have begun, or another target been set
  for (std::size_t i = 0; i < moving.size(); ++i) {
    MovingBody& body = moving[i];
    inertias[i] = body.inertia();
    if (!body.isFree()) continue;
    body.begin();
    body.evaluateLoad(inside, body.state(), external[i]);
    begins[i] = {contacts[i], body.load(), body.drive().power, body.drive().loss};
  }
  for (Coupling& coupling : couplings) {
    const bool is_drive = coupling.body_a == detail::kNoBody;
    coupling.twist = coupling.jacobian_b * motions[coupling.body_b].twist;
    if (is_drive) {
      const MovingBody& body = moving[coupling.body_b];
      const FrameMotion target = body.targetMotion(time, inside);
      coupling.twist -= detail::jacobianAt(body.targetPose(time), target.centre) * target.twist;
    } else {
      coupling.twist += coupling.jacobian_a * motions[coupling.body_a].twist;
    }
    coupling.begin = coupling.force;
    coupling.begin.wrench = coupling.force.wrenchAt(coupling.twist);
    coupling.begin.twist = coupling.twist;
    coupling.stiffness_rate = coupling.damping_rate = 0.0;
    if (!coupling.begin.acts) continue;
    coupling.stiffness_rate = rateOf(coupling.begin.linearisation.stiffness, coupling, inertias);
    coupling.damping_rate = rateOf(coupling.begin.linearisation.damping, coupling, inertias);
  }
  equations.findIslands(inertias, couplings);
  findLoads();
  for (detail::PairRunner& runner : runners) runner.keep();
  allowDisplacements();
}

// What presses on a pair from outside is what acts on the body less its own force: of two the smaller.
void Simulation::State::findLoads() {
  for (std::size_t i = 0; i < moving.size(); ++i) {
    if (!moving[i].isFree()) continue;
    const Wrench steady = moving[i].steadyWrench(settings.gravity);
    impulses[i] << steady.force, steady.torque;
  }
  const auto add = [&](const Coupling& coupling, std::size_t body, const Matrix6d& jacobian) {
    if (body != detail::kNoBody && coupling.begin.acts) {
      impulses[body].noalias() += jacobian.transpose() * coupling.begin.wrench;
    }
  };
  for (const Coupling& coupling : couplings) {
    add(coupling, coupling.body_a, coupling.jacobian_a);
    add(coupling, coupling.body_b, coupling.jacobian_b);
  }
  for (Coupling& coupling : couplings) {
    coupling.load = std::numeric_limits<double>::infinity();
    for (const std::size_t body : {coupling.body_a, coupling.body_b}) {
      if (body == detail::kNoBody || !moving[body].isFree()) continue;
      const Matrix6d& jacobian = body == coupling.body_b ? coupling.jacobian_b : coupling.jacobian_a;
      const Vector6d others = impulses[body] - jacobian.transpose() * coupling.begin.wrench;
      coupling.load = std::min(coupling.load, others.head<3>().norm());
    }
    if (std::isinf(coupling.load)) coupling.load = 0.0;
  }
}

Wrench Simulation::State::sumOn(std::size_t body, const Vector6d Coupling::*wrench) const {
  Vector6d sum = Vector6d::Zero();
  for (const Coupling& coupling : couplings) {
    if (coupling.body_b == body) sum.noalias() += coupling.jacobian_b.transpose() * (coupling.*wrench);
    if (coupling.body_a == body) sum.noalias() += coupling.jacobian_a.transpose() * (coupling.*wrench);
  }
  return detail::toWrench(sum);
}

// The twists V of the drift: M (V - V0) = p h (w - p K h V - D (V - V0)), p the weight of the step's end. The
// couplings' mean wrenches follow from them. All of it over 2 p, which leaves it symmetric.
void Simulation::State::predict(double step) {
  chooseWeights(step);
  for (Coupling& coupling : couplings) {
    coupling.used.setZero();
    coupling.resistance.setZero();
    if (!coupling.begin.acts) continue;
    const ContactLinearisation& now = coupling.begin.linearisation;
    const Matrix6d stiffness = coupling.weights.ofResistance(now.stiffness, 1.0);
    coupling.resistance = 0.5 * step * (step * stiffness + now.damping);
    coupling.used = coupling.begin.wrench - step * (stiffness * coupling.twist);
  }
  for (std::size_t i = 0; i < moving.size(); ++i) {
    if (moving[i].isFree()) impulses[i] = 0.5 * step * wrenchOn(i);
  }
  equations.solve(inertias, masses, impulses, couplings, changes);
  for (Coupling& coupling : couplings) {
    coupling.used -= coupling.resistance * coupling.change / (0.5 * step);
    coupling.displacement = step * (coupling.twist + coupling.change);
  }
}

Vector6d Simulation::State::wrenchOn(std::size_t body) const {
  Wrench wrench = moving[body].steadyWrench(settings.gravity);
  wrench += sumOn(body, &Coupling::used);
  Vector6d vector;
  vector << wrench.force, wrench.torque;
  return vector;
}

// Equal and opposite wrenches of each coupling, and not the solution, move the bodies: momentum is kept.
void Simulation::State::drift(double step) {
  for (std::size_t i = 0; i < moving.size(); ++i) {
    MovingBody& body = moving[i];
    if (body.isFree()) {
      const Vector6d wrench = wrenchOn(i);
      const Vector6d first = weights[i].ofWrench(wrench);
      body.kick(detail::toWrench(first), step);
      left_of_begin[i] = 0.5 * wrench - first;
      changes[i] *= 2.0;
      if (!weights[i].even()) changes[i].noalias() = inertias[i].inverse() * (step * wrench);
      losses[i] = -step * changes[i].dot(left_of_begin[i]);
    }
    drifts[i] = body.drift(time_at_begin, step);
  }
  for (Coupling& coupling : couplings) findChange(coupling);
}

// With its loss: the mean wrench is that of the trapezoidal rule but for what acts against the displacement.
void Simulation::State::findChange(Coupling& coupling) const {
  coupling.full_change.setZero();
  coupling.loss = 0.0;
  bool even = coupling.weights.even();
  const auto add = [&](std::size_t body, const Matrix6d& jacobian) {
    if (body == detail::kNoBody || !moving[body].isFree()) return;
    coupling.full_change.noalias() += jacobian * changes[body];
    coupling.loss += losses[body];
    even = even && weights[body].even();
  };
  add(coupling.body_b, coupling.jacobian_b);
  add(coupling.body_a, coupling.jacobian_a);
  if (even || !coupling.begin.acts) {
    coupling.loss = 0.0;
    return;
  }
  const ContactLinearisation& now = coupling.begin.linearisation;
  const Vector6d missed = 0.5 * (now.stiffness * coupling.displacement + now.damping * coupling.full_change);
  coupling.loss += std::abs(coupling.displacement.dot(coupling.begin.wrench - missed - coupling.used));
}

// Half of the wrenches act where the bodies were at the begin, half where they are: so each coupling's stay
// equal and opposite, however the weights of its bodies differ.
void Simulation::State::evaluateEnd(double step, double inside) {
  for (std::size_t i = 0; i < moving.size(); ++i) moving[i].report(time, inside, bodies[i]);
  setMotions(inside);
  setJacobians();
  for (std::size_t i = 0; i < moving.size(); ++i) {
    MovingBody& body = moving[i];
    if (!body.isFree()) continue;
    body.evaluateLoad(inside, body.state(), external[i]);
    Wrench wrench = detail::toWrench(0.5 * wrenchOn(i));
    if (!weights[i].even()) wrench += movedTo(drifts[i].shift, detail::toWrench(left_of_begin[i]));
    body.kick(wrench, step);
    body.report(time, inside, bodies[i]);
  }
  setMotions(inside);
  evaluateDrives(inside);
  evaluateContacts(step);
  for (Coupling& coupling : couplings) {
    const CouplingForce& begin = coupling.begin;
    coupling.residual = coupling.force.wrench - begin.wrench;
    if (!begin.acts) continue;
    coupling.residual += begin.linearisation.stiffness * coupling.displacement +
                         begin.linearisation.damping * coupling.full_change;
  }
}

// What the linear model has missed of the wrench at the end, against the stiffness and damping there.
void Simulation::State::correct(double step) {
  for (std::size_t i = 0; i < moving.size(); ++i) {
    inertias[i] = moving[i].inertia();
    if (moving[i].isFree()) masses[i] = inertias[i].matrix();
  }
  for (Coupling& coupling : couplings) {
    const ContactLinearisation& end = coupling.force.linearisation;
    if (coupling.force.acts && !coupling.begin.acts) {
      coupling.begin.acts = true;
      weigh(coupling, step * (step * end.stiffness + end.damping));
    }
    coupling.resistance = step * (step * coupling.weights.ofResistance(end.stiffness, 2.0) +
                                  coupling.weights.ofResistance(end.damping, 1.0));
    coupling.used = step * coupling.weights.ofWrench(coupling.residual);
  }
  for (std::size_t i = 0; i < moving.size(); ++i) {
    const Wrench impulse = sumOn(i, &Coupling::used);
    impulses[i] << impulse.force, impulse.torque;
  }
  equations.findIslands(inertias, couplings);
  equations.solve(inertias, masses, impulses, couplings, changes);
  for (Coupling& coupling : couplings) coupling.used -= coupling.resistance * coupling.change;
  for (std::size_t i = 0; i < moving.size(); ++i) {
    if (moving[i].isFree()) moving[i].kick(sumOn(i, &Coupling::used), 1.0);
  }
}

void Simulation::State::restore(double inside) {
  time = time_at_begin;
  for (std::size_t i = 0; i < moving.size(); ++i) {
    if (moving[i].isFree()) moving[i].restore();
    moving[i].report(time, inside, bodies[i]);
  }
  setMotions(inside);
  setJacobians();
  for (std::size_t i = 0; i < moving.size(); ++i) {
    if (moving[i].isFree()) moving[i].evaluateLoad(inside, moving[i].state(), external[i]);
  }
  for (detail::PairRunner& runner : runners) runner.goBack();
}

}  // namespace concave_distance
