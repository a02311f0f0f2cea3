#include "run_experiment.h"

#include <tbb/parallel_for_each.h>

#include <algorithm>
#include <mutex>
#include <vector>

#include "base/csv_writer.h"
#include "row_parameters.h"
#include "search/grid/body_grid.h"
#include "trial_files.h"

namespace concave_distance::evaluation {
namespace {

/// Runs of a unit of work: so many that opening and closing costs nothing, so few that nothing is lost.
constexpr std::uint32_t kRunsAtOnce = 10;

/// What the scenes are, for the report.
void writeScenes(const Experiment& experiment, const std::vector<SceneTruth>& scenes,
                 const std::string& folder) {
  CsvFile file(
      folder + "/" + experiment.name + "_scenes.csv",
      "scene,max_edge_length,nodes_a,nodes_b,exact_distance,node_distance,second_distance,niches,instants");
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const SceneTruth& scene = scenes[i];
    const InstantTruth& truth = scene.first();
    double niches = 0.0;
    for (const InstantTruth& instant : scene.instants) {
      niches += static_cast<double>(nicheCount(instant)) / static_cast<double>(scene.instants.size());
    }
    file.cells() << experiment.scenes[i].name
                 << std::max(gridOf(*scene.a).nodes().max_edge_length,
                             gridOf(*scene.b).nodes().max_edge_length)
                 << gridOf(*scene.a).graph().nodeCount() << gridOf(*scene.b).graph().nodeCount()
                 << truth.exact_distance << truth.node_distance << truth.second_distance << niches
                 << scene.instants.size();
    file.cells().endLine();
  }
  file.finish();
}

}  // namespace

void runExperiment(const Experiment& experiment, const EvaluationOptions& options,
                   const ProgressObserver& progress) {
  std::vector<SceneTruth> scenes;
  for (const ExperimentScene& scene : experiment.scenes) scenes.push_back(loadScene(scene, options.meshes));
  for (SceneTruth& scene : scenes) {
    for (InstantTruth& instant : scene.instants) instant.hidden_count = !experiment.visible_niches;
  }
  TrialFiles files(experiment, options.output);
  writeScenes(experiment, scenes, options.output);
  writeRows(experiment, options.output);
  std::vector<WorkUnit> units;
  std::uint64_t done = 0;
  std::uint64_t all = 0;
  std::uint64_t number = 0;
  for (std::size_t row = 0; row < experiment.rows.size(); ++row) {
    for (std::size_t scene = 0; scene < scenes.size(); ++scene) {
      for (std::uint32_t first = 0; first < options.runs; first += kRunsAtOnce) {
        if (number++ % options.shard_count != options.shard) continue;
        const WorkUnit unit{row, scene, first, std::min(kRunsAtOnce, options.runs - first)};
        all += unit.run_count;
        if (files.contains(unit)) {
          done += unit.run_count;
        } else {
          units.push_back(unit);
        }
      }
    }
  }
  progress(done, all);
  std::mutex writing;
  tbb::parallel_for_each(units.begin(), units.end(), [&](const WorkUnit& unit) {
    const SceneTruth& scene = scenes[unit.scene];
    SearchWorkspace workspace(*scene.a, *scene.b);
    std::vector<CurvePoint> curve;
    const std::vector<TrialRecord> records =
        runTrials(experiment, unit.row, unit.scene, scene, unit.first_run, unit.run_count, workspace,
                  experiment.curves ? &curve : nullptr);
    const std::lock_guard<std::mutex> lock(writing);
    files.append(unit, records, curve);
    done += unit.run_count;
    progress(done, all);
  });
}

}  // namespace concave_distance::evaluation
