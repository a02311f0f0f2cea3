#include "benchmark/engines/engine_differences.h"
#include "concave_distance/base/error.h"
#include "concave_distance/simulation/simulation.h"

namespace concave_distance::benchmark {
namespace {

EngineSample sampleOf(const Simulation& simulation, std::size_t body) {
  const SimulatedBody& now = simulation.bodies()[body];
  return {simulation.time(), now.centre, now.velocity, now.world_from_body.linear(), now.angular_velocity};
}

}  // namespace

Trajectory runOwn(const ComparedScene& scene, double rate, const OwnOptions& options) {
  SimulationSettings settings = scene.settings();
  settings.largest_step *= options.step_scale;
  settings.step_fraction *= options.step_scale;
  for (SimulatedBodySettings& body : settings.bodies) {
    if (body.body != scene.scene.bodies[scene.body].name) continue;
    const Eigen::Translation3d centre(scene.mass.centre_in_body);
    body.pose = body.pose * centre * options.turned * centre.inverse();
  }
  Simulation simulation(scene.scene, settings);
  Trajectory trajectory = {sampleOf(simulation, scene.body)};
  for (std::size_t i = 1; i < sampleCount(scene, rate); ++i) {
    if (simulation.advanceTo(static_cast<double>(i) / rate) != SimulationStatus::Ok) {
      throw Error(scene.name, "our simulation diverged", "take smaller steps");
    }
    trajectory.push_back(sampleOf(simulation, scene.body));
  }
  return trajectory;
}

}  // namespace concave_distance::benchmark
