#include <Eigen/LU>
#include <algorithm>

#include "simulation_state.h"

namespace concave_distance {

using detail::Coupling;

namespace {

bool isFree(const std::vector<detail::StepEquations::Inertia>& inertias, std::size_t body) {
  return body != detail::kNoBody && inertias[body].mass > 0.0;
}

Matrix6d resistanceOf(const Coupling& coupling, double step) {
  const ContactLinearisation& now = coupling.begin.linearisation;
  return step * (step * now.stiffness + now.damping);
}

/// From an impulse of the coupling to the change of its relative twist.
Matrix6d mobilityOf(const Coupling& coupling, const std::vector<detail::StepEquations::Inertia>& inertias) {
  Matrix6d mobility = Matrix6d::Zero();
  const auto add = [&](std::size_t body, const Matrix6d& jacobian) {
    if (!isFree(inertias, body)) return;
    mobility.noalias() += jacobian * (inertias[body].inverse() * jacobian.transpose()).eval();
  };
  add(coupling.body_a, coupling.jacobian_a);
  add(coupling.body_b, coupling.jacobian_b);
  return mobility;
}

}  // namespace

// What a step resolves it leaves to the trapezoidal rule, by direction: of each coupling, how its wrench is
// taken over the step, and of each body, how much of its impulse comes at the begin. Of free bodies that hang
// together one weight for all directions: what is at rest would be kicked unevenly and not stay so.
void Simulation::State::chooseWeights(double step) {
  // Of each island, at its root: the most time scales that the step is long, and whether free bodies touch.
  const auto longest = [&](std::size_t body) -> double& { return impulses[equations.islandOf(body)][0]; };
  const auto together = [&](std::size_t body) -> double& { return impulses[equations.islandOf(body)][1]; };
  for (std::size_t i = 0; i < moving.size(); ++i) {
    masses[i].setZero();
    impulses[i].setZero();
  }
  for (const Coupling& coupling : couplings) {
    if (!coupling.begin.acts) continue;
    const Matrix6d resistance = resistanceOf(coupling, step);
    const double scales = std::max(step * step * coupling.stiffness_rate, step * coupling.damping_rate);
    const bool both = isFree(inertias, coupling.body_a) && isFree(inertias, coupling.body_b);
    for (const std::size_t body : {coupling.body_a, coupling.body_b}) {
      if (!isFree(inertias, body)) continue;
      const Matrix6d& jacobian = body == coupling.body_b ? coupling.jacobian_b : coupling.jacobian_a;
      masses[body].noalias() += jacobian.transpose() * (resistance * jacobian).eval();
      longest(body) = std::max(longest(body), scales);
      if (both) together(body) = 1.0;
    }
  }
  for (Coupling& coupling : couplings) {
    coupling.weights.reset();
    if (!coupling.begin.acts) continue;
    const std::size_t body = isFree(inertias, coupling.body_b) ? coupling.body_b : coupling.body_a;
    if (!isFree(inertias, body)) continue;
    const bool one_weight = together(body) > 0.0;
    const Matrix6d mobility = mobilityOf(coupling, inertias);
    coupling.weights.choose(
        mobility, one_weight ? Matrix6d(longest(body) * mobility.inverse()) : resistanceOf(coupling, step));
  }
  for (std::size_t i = 0; i < moving.size(); ++i) {
    weights[i].reset();
    if (!moving[i].isFree()) continue;
    const Matrix6d mass = inertias[i].matrix();
    weights[i].choose(inertias[i].inverse(), together(i) > 0.0 ? Matrix6d(longest(i) * mass) : masses[i]);
    masses[i] = weights[i].massInStep(mass);
  }
}

/// @param resistance step^2 times the stiffness and step times the damping
void Simulation::State::weigh(Coupling& coupling, const Matrix6d& resistance) const {
  const Matrix6d mobility = mobilityOf(coupling, inertias);
  if (mobility(0, 0) > 0.0) coupling.weights.choose(mobility, resistance);
}

}  // namespace concave_distance
