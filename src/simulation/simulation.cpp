#include "concave_distance/simulation/simulation.h"

#include "concave_distance/base/error.h"
#include "simulation_state.h"

namespace concave_distance {
namespace {

using detail::MovingBody;

const SimulationSettings& requireSection(const Scene& scene) {
  if (!scene.simulation) {
    throw Error("scene", "there is no section `simulation`", "add one: doc/scene_file.md");
  }
  return *scene.simulation;
}

/// Refuses a scene with problems: what is left out holds nothing, so that the rest would move wrongly.
const Scene& requireWhole(const Scene& scene) {
  if (!scene.problems.empty()) {
    throw Error(scene.problems.front().where, scene.problems.front().message,
                "a simulation needs the whole scene: mend the entry or remove it");
  }
  return scene;
}

}  // namespace

std::string_view toString(StepLimit limit) {
  constexpr std::string_view kNames[] = {"largest", "event", "distance", "accuracy", "rotation"};
  return kNames[static_cast<std::size_t>(limit)];
}

std::string_view toString(SimulationStage stage) {
  constexpr std::string_view kNames[] = {"solve", "effects", "single", "integration"};
  return kNames[static_cast<std::size_t>(stage)];
}

Simulation::Simulation(const Scene& scene) : Simulation(scene, requireSection(scene)) {}
Simulation::Simulation(const Scene& scene, const SimulationSettings& settings)
    : state_(std::make_unique<State>(requireWhole(scene), settings)) {}
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

const std::vector<std::string>& Simulation::warnings() const {
  return state_->warnings;
}

bool Simulation::energyIsBalanced() const {
  return state_->energy.balanceShare() <= state_->settings.energy_tolerance;
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

void Simulation::setDriveTarget(std::size_t body, const Eigen::Isometry3d& world_from_target) {
  MovingBody& moving = state_->moving[body];
  if (!moving.hasDrive()) {
    throw Error("body '" + state_->bodies[body].name + "'", "it has no drive", "give it one: `drive`");
  }
  const double before = moving.drive().spring_energy;
  moving.setDriveTarget(world_from_target);
  // Moving the target at once puts energy into the spring.
  state_->evaluateDrives(state_->time);
  state_->energy.drive_work += moving.drive().spring_energy - before;
  state_->sumEnergies();
}

}  // namespace concave_distance
