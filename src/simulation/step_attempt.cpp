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
    coupling.stiffness_rate = detail::sumOfScales(coupling.begin.linearisation.stiffness, coupling, inertias);
    coupling.damping_rate = detail::sumOfScales(coupling.begin.linearisation.damping, coupling, inertias);
  }
  equations.findIslands(inertias, couplings);
  findLoads();
  for (detail::PairRunner& runner : runners) runner.keep();
  allowDisplacements();
}

// A pair is pressed from outside by what acts on the body less its own force: of two bodies the smaller.
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

Vector6d Simulation::State::sumOn(std::size_t body, const Vector6d Coupling::*wrench) const {
  Vector6d sum = Vector6d::Zero();
  for (const Coupling& coupling : couplings) {
    if (coupling.body_b == body) sum.noalias() += coupling.jacobian_b.transpose() * (coupling.*wrench);
    if (coupling.body_a == body) sum.noalias() += coupling.jacobian_a.transpose() * (coupling.*wrench);
  }
  return sum;
}

Vector6d Simulation::State::wrenchOn(std::size_t body) const {
  Wrench wrench = moving[body].steadyWrench(settings.gravity);
  wrench += detail::toWrench(sumOn(body, &Coupling::used));
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
      if (unresolved) {
        const Wrench steady = body.steadyWrench(settings.gravity);
        impulses[i] << 0.5 * step * steady.force, 0.5 * step * steady.torque;
        impulses[i] += sumOn(i, &Coupling::first);
        left_of_begin[i] = 0.5 * step * wrench - impulses[i];
        changes[i] = inertias[i].changeBy(step * wrench);
        body.kick(detail::toWrench(impulses[i]), 1.0);
      } else {
        changes[i] *= 2.0;
        body.kick(detail::toWrench(0.5 * wrench), step);
      }
    }
    drifts[i] = body.drift(time_at_begin, step);
  }
  for (Coupling& coupling : couplings) findChange(coupling, step);
}

// The loss is exact for the linear model: by how much the bodies gain less by the wrenches as they are used
// than by the mean of those at begin and end over the displacement.
void Simulation::State::findChange(Coupling& coupling, double step) const {
  coupling.full_change.setZero();
  Vector6d early = Vector6d::Zero();
  const auto add = [&](std::size_t body, const Matrix6d& jacobian) {
    if (body == detail::kNoBody || !moving[body].isFree()) return;
    coupling.full_change.noalias() += jacobian * changes[body];
    if (unresolved) early.noalias() += jacobian * inertias[body].changeBy(impulses[body]);
  };
  add(coupling.body_b, coupling.jacobian_b);
  add(coupling.body_a, coupling.jacobian_a);
  coupling.displacement = step * (coupling.twist + (unresolved ? early : coupling.change));
  coupling.loss = 0.0;
  if (!unresolved || !coupling.begin.acts) return;
  const ContactLinearisation& now = coupling.begin.linearisation;
  const Vector6d missed = 0.5 * (now.stiffness * coupling.displacement + now.damping * coupling.full_change);
  coupling.loss = std::abs(coupling.displacement.dot(coupling.begin.wrench - missed - coupling.used) +
                           coupling.full_change.dot(coupling.first - 0.5 * step * coupling.used));
}

// Half of the wrenches act where the bodies were at the begin, half where they are: so each coupling's stay
// equal and opposite, however much of them came at the begin.
void Simulation::State::evaluateEnd(double step, double inside) {
  for (std::size_t i = 0; i < moving.size(); ++i) moving[i].report(time, inside, bodies[i]);
  setMotions(inside);
  setJacobians();
  for (std::size_t i = 0; i < moving.size(); ++i) {
    MovingBody& body = moving[i];
    if (!body.isFree()) continue;
    body.evaluateLoad(inside, body.state(), external[i]);
    body.kick(detail::toWrench(0.5 * wrenchOn(i)), step);
    if (unresolved) body.kick(movedTo(drifts[i].shift, detail::toWrench(left_of_begin[i])), 1.0);
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
