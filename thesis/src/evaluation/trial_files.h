#pragma once

#include <cstdint>
#include <fstream>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "trial.h"

namespace concave_distance::evaluation {

/// Runs first, first + 1, ... of one row on one scene: what is done in one go and written in one go.
struct WorkUnit {
  std::size_t row;
  std::size_t scene;
  std::uint32_t first_run;
  std::uint32_t run_count;
};

/// The files of an experiment: `<folder>/<name>.csv`, a line a run; with curves `<folder>/<name>_curves.csv`,
/// sums over the runs of a unit at each generation; with points `<folder>/<name>_points.csv`, a line a run,
/// or with population_points a line an individual of the first run.
/// They are appended to, unit by unit, the runs' file last: what an interrupted evaluation has left is gone
/// on from (a last line that was cut off is dropped, its run done again), and the files of several shards are
/// merged by joining them.
class TrialFiles {
 public:
  /// Opens or begins the files. @throws Error when they cannot be written, belong to another experiment or
  /// have a line in them that is no whole run
  TrialFiles(const Experiment& experiment, const std::string& folder);

  /// Whether the runs of this unit are in the file already.
  bool contains(const WorkUnit& unit) const;
  void append(const WorkUnit& unit, const std::vector<TrialRecord>& records,
              const std::vector<CurvePoint>& curve);

 private:
  void appendPoints(const WorkUnit& unit, const std::vector<TrialRecord>& records);
  void readDone(const std::string& path);

  const Experiment& experiment_;
  std::ofstream runs_;
  std::ofstream curves_;
  std::ofstream points_;
  std::set<std::tuple<std::string, std::string, std::uint32_t>> done_;  ///< row, scene, run
};

}  // namespace concave_distance::evaluation
