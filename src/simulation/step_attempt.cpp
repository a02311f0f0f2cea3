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

// One weight for all that hangs together, or what is at rest would be kicked unevenly and not stay so.
void Simulation::State::chooseWeights(double step) {
  std::fill(weights.begin(), weights.end(), 0.5);
  for (const Coupling& coupling : couplings) {
    if (!coupling.begin.acts) continue;
    const double weight =
        detail::endWeight(detail::timeScales(coupling.stiffness_rate, coupling.damping_rate, step));
    for (const std::size_t body : {coupling.body_a, coupling.body_b}) {
      if (body == detail::kNoBody || !moving[body].isFree()) continue;
      double& island = weights[equations.islandOf(body)];
      island = std::max(island, weight);
    }
  }
  for (std::size_t i = 0; i < moving.size(); ++i) weights[i] = weights[equations.islandOf(i)];
  for (Coupling& coupling : couplings) {
    const bool free_b = moving[coupling.body_b].isFree();
    coupling.weight =
        weights[free_b || coupling.body_a == detail::kNoBody ? coupling.body_b : coupling.body_a];
  }
}

// The twists V of the drift: M (V - V0) = p h (w - p K h V - D (V - V0)), p the weight of the step's end. The
// couplings' mean wrenches follow from them.
void Simulation::State::predict(double step) {
  chooseWeights(step);
  for (Coupling& coupling : couplings) {
    coupling.used.setZero();
    coupling.resistance.setZero();
    if (!coupling.begin.acts) continue;
    const ContactLinearisation& now = coupling.begin.linearisation;
    const double part = coupling.weight * step;
    coupling.resistance = part * (part * now.stiffness + now.damping);
    coupling.used = coupling.begin.wrench - part * (now.stiffness * coupling.twist);
  }
  for (std::size_t i = 0; i < moving.size(); ++i) {
    if (!moving[i].isFree()) continue;
    Wrench wrench = moving[i].steadyWrench(settings.gravity);
    wrench += sumOn(i, &Coupling::used);
    const double part = weights[i] * step;
    impulses[i] << part * wrench.force, part * wrench.torque;
  }
  equations.solve(inertias, impulses, couplings, changes);
  for (Coupling& coupling : couplings) {
    coupling.used -= coupling.resistance * coupling.change / (coupling.weight * step);
    coupling.displacement = step * (coupling.twist + coupling.change);
  }
}

// Equal and opposite wrenches of each coupling, and not the solution, move the bodies: momentum is kept.
void Simulation::State::drift(double step) {
  for (std::size_t i = 0; i < moving.size(); ++i) {
    MovingBody& body = moving[i];
    if (body.isFree()) {
      Wrench wrench = body.steadyWrench(settings.gravity);
      wrench += sumOn(i, &Coupling::used);
      body.kick(wrench, weights[i] * step);
    }
    drifts[i] = body.drift(time_at_begin, step);
  }
}

void Simulation::State::evaluateEnd(double step, double inside) {
  for (std::size_t i = 0; i < moving.size(); ++i) moving[i].report(time, inside, bodies[i]);
  setMotions(inside);
  setJacobians();
  for (std::size_t i = 0; i < moving.size(); ++i) {
    MovingBody& body = moving[i];
    if (!body.isFree()) continue;
    body.evaluateLoad(inside, body.state(), external[i]);
    Wrench wrench = body.steadyWrench(settings.gravity);
    wrench += sumOn(i, &Coupling::used);
    body.kick(wrench, (1.0 - weights[i]) * step);
    body.report(time, inside, bodies[i]);
  }
  setMotions(inside);
  evaluateDrives(inside);
  evaluateContacts(step);
  for (Coupling& coupling : couplings) {
    const CouplingForce& begin = coupling.begin;
    const CouplingForce& end = coupling.force;
    coupling.residual = end.wrench - begin.wrench;
    if (!begin.acts) continue;
    coupling.residual += begin.linearisation.stiffness * coupling.displacement +
                         begin.linearisation.damping * coupling.change / coupling.weight;
  }
}

// What the linear model has missed of the wrench at the end, against the stiffness and damping there.
void Simulation::State::correct(double step) {
  for (std::size_t i = 0; i < moving.size(); ++i) inertias[i] = moving[i].inertia();
  for (Coupling& coupling : couplings) {
    const ContactLinearisation& end = coupling.force.linearisation;
    if (coupling.force.acts && !coupling.begin.acts) {
      coupling.begin.acts = true;
      coupling.weight = detail::endWeight(detail::timeScales(rateOf(end.stiffness, coupling, inertias),
                                                             rateOf(end.damping, coupling, inertias), step));
    }
    const double part = coupling.weight * step;
    coupling.resistance = part * (part * end.stiffness + end.damping);
    coupling.used = part * coupling.residual;
  }
  for (std::size_t i = 0; i < moving.size(); ++i) {
    const Wrench impulse = sumOn(i, &Coupling::used);
    impulses[i] << impulse.force, impulse.torque;
  }
  equations.findIslands(inertias, couplings);
  equations.solve(inertias, impulses, couplings, changes);
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
