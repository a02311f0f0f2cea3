#include <algorithm>
#include <chrono>

#include "benchmark/contact_scenes.h"
#include "benchmark/support/contact_stage.h"
#include "benchmark/support/interference_scenes.h"
#include "benchmark/support/stopwatch.h"
#include "concave_distance/loading/load_scene.h"
#include "support/body_pairs.h"

namespace concave_distance::benchmark {
namespace {

/// A scene of config/ as `simulate` runs it, without writing.
void runConfig(SceneReport& report, const std::string& name, double wanted,
               double work_tolerance = SimulationSettings().work_tolerance) {
  SceneLoadOptions options;
  options.package_locator = [](const std::string&) { return std::string(CONCAVE_DISTANCE_SOURCE_DIR); };
  Scene scene = loadSceneFile(std::string(CONCAVE_DISTANCE_SOURCE_DIR) + "/config/" + name, options);
  scene.simulation->work_tolerance = work_tolerance;
  Simulation simulation(scene);
  const double duration = simulation.settings().duration;
  SceneRun run(std::move(simulation), duration, report);
  while (run.step()) continue;
  report.realTimeFactor(run.figures(), wanted);
}

/// Bumpy rings that overlap, as in interference_benchmark.
void regions(SceneReport& report) {
  for (const InterferenceScene& scene : interferenceScenes()) {
    if (scene.name.rfind("rings of ", 0) != 0) continue;
    const auto a = test::makeBody(scene.pair.a);
    const auto b = test::makeBody(scene.pair.b);
    InterferenceWorkspace workspace;
    Interference found;
    const double alone = fastest([&] { findInterference(*a, *b, scene.pair.a_from_b, workspace, found); });
    report.note({"regions; " + scene.name, "us", alone});
    PairSolution touching;
    touching.a_from_b = scene.pair.a_from_b;
    touching.distance = touching.lower_bound = 0.0;
    for (const NormalForceModel model :
         {NormalForceModel::HuntCrossley, NormalForceModel::ElasticFoundation}) {
      PairEffects effects(a, b, effectsOf(model, FrictionModel::Bristle), inContact(Material(), Material()));
      PairContacts contacts;
      const double all = fastest([&] { effects.update(touching, RelativeTwist(), 0.0, contacts); });
      report.note({"with " + std::string(toString(model)) + " and bristles; " + scene.name, "us", all});
    }
  }
}

}  // namespace

ContactScenes speedScenes() {
  return {{"peg_in_hole", "config/peg_in_hole.yaml",
           [](SceneReport& report) { runConfig(report, "peg_in_hole.yaml", 5.0); }},
          {"peg_in_hole_coarse", "the same with a work_tolerance of 0.05",
           [](SceneReport& report) { runConfig(report, "peg_in_hole.yaml", 5.0, 0.05); }},
          {"insertion", "config/insertion_simulation.yaml",
           [](SceneReport& report) { runConfig(report, "insertion_simulation.yaml", 10.0); }},
          {"regions", "time of the regions of 1000 to 100,000 triangles", regions}};
}

}  // namespace concave_distance::benchmark
