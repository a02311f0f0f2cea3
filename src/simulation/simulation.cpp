#include "concave_distance/simulation/simulation.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "concave_distance/base/error.h"
#include "moving_body.h"
#include "pair_runner.h"

namespace concave_distance {
namespace {

using detail::ContactSpeeds;
using detail::MovingBody;
using detail::PairRunner;
using detail::trapezoidalWork;

// Explicit damping decays without swinging over up to 1 / rate, and is stable up to twice that.
constexpr double kDampingFraction = 0.5;
// Far below every time scale of a rigid body: steps that get this small have nowhere to go.
constexpr double kVanishingStep = 1e-15;
// Sums of steps miss the time of an event by rounding: this near, relative to the time, it is reached.
constexpr double kSameTime = 1e-13;
// The share of the allowed way that a repeated drift aims at.
constexpr double kAim = 0.9;

Wrench movedTo(const Wrench& about_origin, const Eigen::Vector3d& point) {
  return {about_origin.force, about_origin.torque - point.cross(about_origin.force)};
}

Wrench opposite(const Wrench& wrench) {
  return {-wrench.force, -wrench.torque};
}

Eigen::Vector3d rotationBetween(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to) {
  Eigen::Quaterniond turn = to * from.conjugate();
  if (turn.w() < 0.0) turn.coeffs() = -turn.coeffs();
  const Eigen::AngleAxisd angle_axis(turn);
  return angle_axis.angle() * angle_axis.axis();
}

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

SimulatedBodySettings settingsOf(const SceneBody& body, const SimulationSettings& settings) {
  for (const SimulatedBodySettings& candidate : settings.bodies) {
    if (candidate.body == body.name) return candidate;
  }
  SimulatedBodySettings fixed;
  fixed.body = body.name;
  fixed.motion = BodyMotion::Fixed;
  return fixed;
}

const SimulationSettings& requireSection(const Scene& scene) {
  if (!scene.simulation) {
    throw Error("scene", "there is no section `simulation`", "add one: doc/scene_file.md");
  }
  return *scene.simulation;
}

}  // namespace

std::string_view toString(StepLimit limit) {
  constexpr std::string_view kNames[] = {"largest", "event", "distance", "stiffness", "damping", "rotation"};
  return kNames[static_cast<std::size_t>(limit)];
}

std::string_view toString(SimulationStage stage) {
  constexpr std::string_view kNames[] = {"solve", "effects", "single", "integration"};
  return kNames[static_cast<std::size_t>(stage)];
}

struct Simulation::State {
  State(const Scene& scene, const SimulationSettings& given);

  double nextEvent(double until) const;
  double limitStep(double event, StepLimit& limit);
  ContactSpeeds speedsOf(std::size_t pair, double step) const;
  double allowedWay(const SimulatedPair& pair) const {
    return pair.lower_bound + settings.allowed_penetration;
  }
  /// The largest share of its allowed way that a pair has gone.
  double shareOfWay() const;
  void evaluateContacts(double step);
  void report(double inside);
  void addWorks(double step);
  void sumEnergies();
  double step(double until);

  SimulationSettings settings;
  double time = 0.0;
  SimulationStatus status = SimulationStatus::Ok;
  std::vector<MovingBody> moving;
  std::vector<PairRunner> runners;
  std::vector<SimulatedBody> bodies;
  std::vector<SimulatedPair> pairs;
  std::vector<BodyContacts> contacts;
  std::vector<StepBegin> begins;
  std::vector<Drift> drifts;
  std::vector<Wrench> external;
  std::vector<ContactSpeeds> speeds;  ///< of each body's contacts, for limitStep
  EnergyAccount energy;
  SimulationCounters counters;
};

Simulation::State::State(const Scene& scene, const SimulationSettings& given) : settings(given) {
  settings.validate("simulation");
  for (const SimulatedBodySettings& body : settings.bodies) {
    if (!scene.findBody(body.body)) {
      throw Error(body.where.empty() ? "simulation" : body.where, "there is no body '" + body.body + "'",
                  "name a body or link of the scene");
    }
  }
  for (const SceneBody& body : scene.bodies) {
    const SimulatedBodySettings body_settings = settingsOf(body, settings);
    moving.emplace_back(body, body_settings);
    SimulatedBody simulated;
    simulated.name = body.name;
    simulated.motion = body_settings.motion;
    bodies.push_back(simulated);
  }
  for (const ScenePair& pair : scene.pairs) {
    if (!pair.enabled || !(moving[pair.body_a].moves() || moving[pair.body_b].moves())) continue;
    runners.emplace_back(scene, pair, settings);
    SimulatedPair simulated;
    simulated.name = pair.name;
    simulated.body_a = pair.body_a;
    simulated.body_b = pair.body_b;
    pairs.push_back(std::move(simulated));
  }
  contacts.resize(bodies.size());
  begins.resize(bodies.size());
  drifts.resize(bodies.size());
  external.resize(bodies.size());
  speeds.resize(bodies.size());
  const double inside = 0.5 * std::min(settings.largest_step, settings.duration);
  for (std::size_t i = 0; i < moving.size(); ++i) {
    if (moving[i].isFree()) moving[i].evaluateExternal(0.0, inside, moving[i].state(), external[i]);
  }
  report(inside);
  evaluateContacts(0.0);
  report(inside);
  sumEnergies();
  energy.initial = energy.mechanical();
  counters = {};  // the steps, without the cold solves of the start
}

ContactSpeeds Simulation::State::speedsOf(std::size_t index, double step) const {
  const SimulatedPair& pair = pairs[index];
  struct Compliance {
    const MovingBody& a;
    const MovingBody& b;
    double along(const Eigen::Vector3d& point, const Eigen::Vector3d& direction) const {
      return (a.isFree() ? a.rigid().compliance(a.state(), point, direction) : 0.0) +
             (b.isFree() ? b.rigid().compliance(b.state(), point, direction) : 0.0);
    }
    double largest(const Eigen::Vector3d& point) const {
      return (a.isFree() ? a.rigid().largestCompliance(a.state(), point) : 0.0) +
             (b.isFree() ? b.rigid().largestCompliance(b.state(), point) : 0.0);
    }
  };
  return runners[index].speeds(pair, bodies[pair.body_a].world_from_body, step,
                               Compliance{moving[pair.body_a], moving[pair.body_b]});
}

double Simulation::State::nextEvent(double until) const {
  double event = until;
  for (const MovingBody& body : moving) event = std::min(event, body.nextEvent(time));
  return event;
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
  const double inside = time + 0.5 * step;
  for (const MovingBody& body : moving) {
    if (body.isFree()) hold(settings.step_fraction / body.angularSpeed(inside), StepLimit::Rotation);
  }
  for (const SimulatedPair& pair : pairs) {
    const MovingBody& a = moving[pair.body_a];
    const MovingBody& b = moving[pair.body_b];
    const double speed = (b.referenceVelocity(inside) - a.referenceVelocity(inside)).norm() +
                         a.spinSpeed(inside) + b.spinSpeed(inside);
    hold(allowedWay(pair) / speed, StepLimit::Distance);
  }
  // Every contact and drive of a body adds to what resists its motion.
  std::fill(speeds.begin(), speeds.end(), ContactSpeeds());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const ContactSpeeds pair = speedsOf(i, step);
    for (const std::size_t body : {pairs[i].body_a, pairs[i].body_b}) {
      speeds[body].stiffness_rate += pair.stiffness_rate;
      speeds[body].damping_rate += pair.damping_rate;
    }
  }
  for (std::size_t i = 0; i < moving.size(); ++i) {
    if (!moving[i].isFree()) continue;
    const double stiffness = speeds[i].stiffness_rate + moving[i].driveStiffnessRate();
    const double damping = speeds[i].damping_rate + moving[i].driveDampingRate();
    hold(settings.step_fraction / std::sqrt(stiffness), StepLimit::Stiffness);
    hold(kDampingFraction / damping, StepLimit::Damping);
  }
  return step;
}

double Simulation::State::shareOfWay() const {
  double share = 0.0;
  for (const SimulatedPair& pair : pairs) {
    const Drift& a = drifts[pair.body_a];
    const Drift& b = drifts[pair.body_b];
    const double way = (b.shift - a.shift).norm() + moving[pair.body_a].radius() * a.turn +
                       moving[pair.body_b].radius() * b.turn;
    share = std::max(share, way / allowedWay(pair));
  }
  return share;
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
    contacts[pair.body_b].normal += movedTo(on_b.normal, b.centre);
    contacts[pair.body_b].friction += movedTo(on_b.friction, b.centre);
    contacts[pair.body_a].normal += movedTo(opposite(on_b.normal), a.centre);
    contacts[pair.body_a].friction += movedTo(opposite(on_b.friction), a.centre);
    for (const ContactRegion& region : pair.contacts.regions) {
      touched = touched || region.normal_force > 0.0;
      if (region.overlap.depth > counters.largest_depth) counters.largest_depth = region.overlap.depth;
    }
  }
  if (touched) ++counters.contact_steps;
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
}

double Simulation::State::step(double until) {
  if (status != SimulationStatus::Ok || !(until > time)) return 0.0;
  const auto start = std::chrono::steady_clock::now();
  const auto seconds_of = [&](SimulationStage stage) {
    return counters.seconds[static_cast<std::size_t>(stage)];
  };
  const double elsewhere = seconds_of(SimulationStage::Solve) + seconds_of(SimulationStage::Effects) +
                           seconds_of(SimulationStage::Single);
  double event = nextEvent(until);
  while (std::isfinite(event) && event - time <= kSameTime * std::max(1.0, std::abs(event))) {
    time = event;
    if (!(until > time)) return 0.0;
    event = nextEvent(until);
  }
  StepLimit limit = StepLimit::Largest;
  double step = limitStep(event, limit);
  double inside = time;
  // Kick and drift, and again with less if that went too far: nothing has been evaluated yet.
  while (true) {
    if (!(step > kVanishingStep)) {
      status = SimulationStatus::Diverged;
      return 0.0;
    }
    inside = time + 0.5 * step;
    for (std::size_t i = 0; i < moving.size(); ++i) {
      MovingBody& body = moving[i];
      if (body.isFree()) {
        body.evaluateExternal(time, inside, body.state(), external[i]);
        begins[i] = {contacts[i], body.load(), body.drive().power, body.drive().loss};
      }
      drifts[i] = body.advance(time, step, contacts[i].sum(), settings.gravity);
    }
    const double share = shareOfWay();
    if (share <= 1.0) break;
    for (MovingBody& body : moving) body.restore();
    ++counters.shortened;
    limit = StepLimit::Distance;
    step *= std::isfinite(share) ? kAim / share : 0.0;
  }
  const bool at_event = limit == StepLimit::Event;
  time = at_event ? event : time + step;  // exactly at an event, whatever the sum rounds to
  // Forces at the end of the step, with velocities extrapolated to it.
  for (std::size_t i = 0; i < moving.size(); ++i) {
    MovingBody& body = moving[i];
    body.report(time, inside, bodies[i]);
    if (!body.isFree()) continue;
    const RigidBodyState ahead = body.extrapolated(step, contacts[i].sum(), settings.gravity);
    bodies[i].velocity = ahead.velocity;
    bodies[i].angular_velocity = body.rigid().angularVelocity(ahead);
    body.evaluateExternal(time, inside, ahead, external[i]);
  }
  evaluateContacts(step);
  bool finite = true;
  for (std::size_t i = 0; i < moving.size(); ++i) {
    MovingBody& body = moving[i];
    if (!body.isFree()) continue;
    body.kick(contacts[i].sum(), settings.gravity, 0.5 * step);
    counters.largest_quaternion_drift =
        std::max(counters.largest_quaternion_drift, std::abs(drifts[i].norm_drift));
    finite = finite && body.state().velocity.allFinite() && body.state().angular_momentum.allFinite();
  }
  if (!finite) status = SimulationStatus::Diverged;
  addWorks(step);
  report(inside);
  sumEnergies();
  ++counters.steps;
  ++counters.limited_by[static_cast<std::size_t>(limit)];
  if (!at_event) counters.smallest_step = std::min(counters.smallest_step, step);
  const double solved = seconds_of(SimulationStage::Solve) + seconds_of(SimulationStage::Effects) +
                        seconds_of(SimulationStage::Single) - elsewhere;
  counters.seconds[static_cast<std::size_t>(SimulationStage::Integration)] +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() - solved;
  return step;
}

Simulation::Simulation(const Scene& scene) : Simulation(scene, requireSection(scene)) {}
Simulation::Simulation(const Scene& scene, const SimulationSettings& settings)
    : state_(std::make_unique<State>(scene, settings)) {}
Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

double Simulation::step(double until) {
  return state_->step(until);
}

SimulationStatus Simulation::advanceTo(double time) {
  while (state_->time < time && state_->step(time) > 0.0) {
  }
  return state_->status;
}

double Simulation::time() const {
  return state_->time;
}
SimulationStatus Simulation::status() const {
  return state_->status;
}
const SimulationSettings& Simulation::settings() const {
  return state_->settings;
}
const std::vector<SimulatedBody>& Simulation::bodies() const {
  return state_->bodies;
}
const std::vector<SimulatedPair>& Simulation::pairs() const {
  return state_->pairs;
}
const EnergyAccount& Simulation::energy() const {
  return state_->energy;
}
const SimulationCounters& Simulation::counters() const {
  return state_->counters;
}

Eigen::Vector3d Simulation::momentum() const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const MovingBody& body : state_->moving) {
    if (body.isFree()) sum += body.rigid().mass() * body.state().velocity;
  }
  return sum;
}

Eigen::Vector3d Simulation::angularMomentum() const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const MovingBody& body : state_->moving) {
    if (!body.isFree()) continue;
    sum += body.state().angular_momentum +
           body.rigid().mass() * body.state().centre.cross(body.state().velocity);
  }
  return sum;
}

void Simulation::setExternalWrench(std::size_t body, const Wrench& about_centre) {
  state_->external[body] = about_centre;
}

void Simulation::setDriveTarget(std::size_t index, const Eigen::Isometry3d& world_from_target) {
  MovingBody& body = state_->moving[index];
  if (!body.hasDrive()) {
    throw Error("body '" + state_->bodies[index].name + "'", "it has no drive", "give it one: `drive`");
  }
  const double before = body.drive().spring_energy;
  body.setDriveTarget(world_from_target);
  body.evaluateExternal(state_->time, state_->time, body.state(), state_->external[index]);
  // Moving the target at once puts energy into the spring.
  state_->energy.drive_work += body.drive().spring_energy - before;
  state_->sumEnergies();
}

}  // namespace concave_distance
