#include "benchmark/engines/engine_table.h"

namespace concave_distance::benchmark {

double TableScene::friction() const {
  return stage.effects.friction.model == FrictionModel::None ? 0.0 : material().dynamic_friction;
}

TableRun runOwnTable(const TableScene& scene) {
  Simulation simulation = scene.stage.simulation();
  TableRun run;
  run.bodies.resize(simulation.bodies().size());
  const auto samples = static_cast<std::size_t>(std::lround(scene.duration * kTableRate));
  const auto start = std::chrono::steady_clock::now();
  for (std::size_t i = 0; i <= samples; ++i) {
    const double time = static_cast<double>(i) / kTableRate;
    while (simulation.time() < time && simulation.status() == SimulationStatus::Ok &&
           run.seconds < kTableWall) {
      simulation.step(time);
      run.seconds = 1e-6 * microsecondsSince(start);
    }
    if (simulation.time() < time) return run;
    for (std::size_t b = 0; b < run.bodies.size(); ++b) {
      const SimulatedBody& now = simulation.bodies()[b];
      run.bodies[b].push_back(
          {time, now.centre, now.velocity, now.world_from_body.linear(), now.angular_velocity});
    }
  }
  run.complete = true;
  return run;
}

}  // namespace concave_distance::benchmark
