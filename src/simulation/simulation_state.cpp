#include "simulation_state.h"

#include <algorithm>
#include <cmath>

#include "concave_distance/base/error.h"
#include "suspicious_start.h"

namespace concave_distance {
namespace {

using detail::BodyContacts;
using detail::MovingBody;
using detail::PairRunner;
using detail::StepBegin;
using detail::trapezoidalWork;

constexpr double kNegligibleLift = 1e-2;  // of a body's radius

Wrench opposite(const Wrench& wrench) {
  return {-wrench.force, -wrench.torque};
}

Eigen::Vector3d rotationBetween(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to) {
  Eigen::Quaterniond turn = to * from.conjugate();
  if (turn.w() < 0.0) turn.coeffs() = -turn.coeffs();
  const Eigen::AngleAxisd angle_axis(turn);
  return angle_axis.angle() * angle_axis.axis();
}

SimulatedBodySettings settingsOf(const SceneBody& body, const SimulationSettings& settings) {
  for (const SimulatedBodySettings& candidate : settings.bodies) {
    if (candidate.body == body.name) return candidate;
  }
  SimulatedBodySettings fixed;
  fixed.body = body.name;
  fixed.motion = BodyMotion::Fixed;
  return fixed;
}

}  // namespace

Simulation::State::State(const Scene& with_rules, const SimulationSettings& given) : settings(given) {
  // Each pair is simulated whether it is near or not.
  Scene scene = with_rules;
  scene.pairs = allPairs(with_rules);
  settings.validate("simulation");
  for (const SimulatedBodySettings& body : settings.bodies) {
    if (!scene.findBody(body.body)) {
      throw Error(body.where.empty() ? "simulation" : body.where, "there is no body '" + body.body + "'",
                  "name a body or link of the scene");
    }
  }
  warnings = detail::warnOfUnheldBodies(scene, settings);
  warn(detail::warnOfMissingPairs(scene, settings));
  addBodies(scene);
  warn(detail::warnOfMasses(scene, settings, moving));
  addPairs(scene);
  addDrives();
  const double inside = 0.5 * std::min(settings.largest_step, settings.duration);
  for (std::size_t i = 0; i < moving.size(); ++i) {
    if (moving[i].isFree()) moving[i].evaluateLoad(inside, moving[i].state(), external[i]);
  }
  evaluateDrives(inside);
  report(inside);
  evaluateContacts(0.0);
  report(inside);
  std::vector<Eigen::Vector3d> normal;
  for (const BodyContacts& on_body : contacts) normal.push_back(on_body.normal.force);
  warn(detail::warnOfDeepStarts(settings, moving, bodies, pairs, normal));
  sumEnergies();
  energy.initial = energy.mechanical();
  for (const MovingBody& body : moving) {
    if (!body.isFree()) continue;
    energy.negligible += kNegligibleLift * body.rigid().mass() * settings.gravity.norm() * body.radius();
  }
  counters = {};  // the steps, without the cold solves of the start
  beginStep(inside);
  for (const detail::Coupling& coupling : couplings) {
    if (coupling.begin.acts) {
      proposed_step = std::min(proposed_step, settings.step_fraction / std::sqrt(coupling.stiffness_rate));
    }
  }
}

void Simulation::State::warn(const std::vector<std::string>& more) {
  warnings.insert(warnings.end(), more.begin(), more.end());
}

void Simulation::State::addBodies(const Scene& scene) {
  for (const SceneBody& body : scene.bodies) {
    const SimulatedBodySettings body_settings = settingsOf(body, settings);
    moving.emplace_back(body, body_settings);
    SimulatedBody simulated;
    simulated.name = body.name;
    simulated.motion = body_settings.motion;
    bodies.push_back(simulated);
  }
  contacts.resize(bodies.size());
  begins.resize(bodies.size());
  drifts.resize(bodies.size());
  external.resize(bodies.size());
  motions.resize(bodies.size());
  inertias.resize(bodies.size());
  left_of_begin.resize(bodies.size());
  impulses.resize(bodies.size());
  changes.resize(bodies.size());
}

void Simulation::State::addPairs(const Scene& scene) {
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    const ScenePair& pair = scene.pairs[i];
    if (!pair.enabled || !pair.settings.effects.any()) continue;
    if (!(moving[pair.body_a].moves() || moving[pair.body_b].moves())) continue;
    runners.emplace_back(scene, i, settings);
    SimulatedPair simulated;
    simulated.name = pair.name;
    simulated.body_a = pair.body_a;
    simulated.body_b = pair.body_b;
    pairs.push_back(std::move(simulated));
    detail::Coupling coupling;
    coupling.body_a = pair.body_a;
    coupling.body_b = pair.body_b;
    couplings.push_back(coupling);
  }
  pair_begins.resize(pairs.size());
}

void Simulation::State::addDrives() {
  for (std::size_t i = 0; i < moving.size(); ++i) {
    if (!moving[i].hasDrive()) continue;
    detail::Coupling coupling;
    coupling.body_b = i;
    coupling.force.acts = true;
    couplings.push_back(coupling);
  }
}

void Simulation::State::evaluateContacts(double step) {
  std::fill(contacts.begin(), contacts.end(), BodyContacts());
  bool touched = false;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    SimulatedPair& pair = pairs[i];
    const SimulatedBody& a = bodies[pair.body_a];
    const SimulatedBody& b = bodies[pair.body_b];
    runners[i].update(time, step, a, b, pair, counters);
    const detail::ContactWrenches on_b = PairRunner::wrenchesOnB(pair, a.world_from_body);
    contacts[pair.body_b].normal += movedTo(b.centre, on_b.normal);
    contacts[pair.body_b].friction += movedTo(b.centre, on_b.friction);
    contacts[pair.body_a].normal += movedTo(a.centre, opposite(on_b.normal));
    contacts[pair.body_a].friction += movedTo(a.centre, opposite(on_b.friction));
    couplings[i].force = PairRunner::forceOnB(pair, a, b);
    for (const ContactRegion& region : pair.contacts.regions) {
      touched = touched || region.normal_force > 0.0;
      if (region.overlap.depth > counters.largest_depth) counters.largest_depth = region.overlap.depth;
    }
  }
  if (touched) ++counters.contact_steps;
}

void Simulation::State::evaluateDrives(double inside) {
  for (std::size_t i = pairs.size(); i < couplings.size(); ++i) {
    detail::Coupling& coupling = couplings[i];
    MovingBody& body = moving[coupling.body_b];
    body.evaluateDrive(time, inside, body.state());
    const Eigen::Isometry3d world_from_target = body.targetPose(time);
    const Eigen::Vector3d centre = body.state().centre;
    // About the target's origin, its axes.
    const Wrench about_target = movedTo(world_from_target.translation() - centre, body.drive().on_body);
    const Eigen::Matrix3d axes = world_from_target.linear().transpose();
    coupling.force.wrench << axes * about_target.force, axes * about_target.torque;
    coupling.force.twist =
        detail::twistBetween(world_from_target, body.targetMotion(time, inside), body.motionAt(time, inside));
    coupling.force.linearisation = body.driveLinearisation(time);
  }
}

void Simulation::State::report(double inside) {
  for (std::size_t i = 0; i < moving.size(); ++i) {
    moving[i].report(time, inside, bodies[i]);
    bodies[i].contact_wrench = contacts[i].sum();
  }
}

void Simulation::State::addWorks(double step) {
  for (std::size_t i = 0; i < moving.size(); ++i) {
    const MovingBody& body = moving[i];
    if (!body.isFree()) continue;
    const StepBegin& begin = begins[i];
    const Eigen::Vector3d& shift = drifts[i].shift;
    const Eigen::Vector3d turn =
        rotationBetween(body.before().world_from_principal, body.state().world_from_principal);
    energy.normal_work += trapezoidalWork(begin.contacts.normal, contacts[i].normal, shift, turn);
    energy.friction_work += trapezoidalWork(begin.contacts.friction, contacts[i].friction, shift, turn);
    energy.load_work += trapezoidalWork(begin.load, body.load(), shift, turn);
    energy.drive_work += 0.5 * step * (begin.drive_power + body.drive().power);
    energy.drive_loss += 0.5 * step * (begin.drive_loss + body.drive().loss);
  }
}

void Simulation::State::sumEnergies() {
  energy.kinetic = energy.gravity_potential = energy.drive_potential = 0.0;
  for (const MovingBody& body : moving) {
    if (!body.isFree()) continue;
    energy.kinetic += body.rigid().kineticEnergy(body.state());
    energy.gravity_potential -= body.rigid().mass() * settings.gravity.dot(body.state().centre);
    energy.drive_potential += body.drive().spring_energy;
  }
  energy.largest_kinetic = std::max(energy.largest_kinetic, energy.kinetic);
}

}  // namespace concave_distance
