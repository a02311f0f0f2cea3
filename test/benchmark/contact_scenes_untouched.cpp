#include <fstream>
#include <sstream>
#include <vector>

#include "benchmark/contact_scenes.h"
#include "benchmark/support/contact_stage.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "support/temporary_folder.h"
#include "tools/simulation_log.h"

namespace concave_distance::benchmark {
namespace {

using test::at;

/// A ball flies through a zone that it is watched against but that no effect acts in.
ContactStage zoneStage(bool watched) {
  ContactStage stage;
  stage.addFixed("zone", makeBox({0.2, 0.2, 0.2}), at(0, 0, 0));
  stage.addFree("ball", makeSphere(0.05, 0.0005), 1.0, at(-0.4, 0, 0)).velocity = {2.0, 0.0, 0.0};
  stage.letMeet("zone", "ball");
  stage.scene.pairs.edit(0).enabled = watched;
  stage.settings.gravity.setZero();
  return stage;
}

RunFigures fly(bool watched, const SceneReport& report) {
  SceneRun run(zoneStage(watched).simulation(), 0.4, report);
  while (run.step()) continue;
  return run.figures();
}

void zoneSteps(SceneReport& report) {
  const RunFigures without = fly(false, report);
  const RunFigures with = fly(true, report);
  report.equals({"steps through a zone without effects", "1", static_cast<double>(with.steps)},
                static_cast<double>(without.steps), 0.0, "as many as without the pair", with);
  report.equals({"smallest step there", "s", with.smallest_step}, without.smallest_step,
                1e-12 * without.smallest_step, "as without the pair", with);
}

std::vector<std::string> cellsOf(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

/// The columns of `simulate --output` that no effect fills, while ball and zone overlap.
void zoneCells(SceneReport& report) {
  Simulation simulation = zoneStage(true).simulation();
  simulation.advanceTo(0.2);
  const test::TemporaryFolder folder;
  const std::string path = folder.path() + "/zone.csv";
  tools::TrajectoryLog log(path, simulation);
  log.write(simulation);
  log.finish();
  std::ifstream file(path);
  std::string header;
  std::string line;
  std::getline(file, header);
  std::getline(file, line);
  const std::vector<std::string> names = cellsOf(header);
  std::vector<std::string> values = cellsOf(line);
  values.resize(names.size());
  for (const char* column : {"regions", "depth", "normal_force"}) {
    const std::string name = std::string("zone/ball.") + column;
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i] != name) continue;
      const bool filled = !values[i].empty();
      report.atMost({"cell `" + std::string(column) + "` is filled in overlap", "1", filled ? 1.0 : 0.0}, 0.0,
                    "not computed: empty");
    }
  }
}

}  // namespace

ContactScenes untouchedScenes() {
  return {{"zone_steps", "a pair without effects and the steps", zoneSteps},
          {"zone_cells", "a pair without effects and the output", zoneCells}};
}

}  // namespace concave_distance::benchmark
