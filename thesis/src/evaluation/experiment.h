#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "concave_distance/tracking/tracker_parameters.h"
#include "experiment_scene.h"
#include "row_bases.h"
#include "search_method.h"
#include "thesis/src/continuous/continuous_parameters.h"

namespace concave_distance::evaluation {

/// All node pairs (Carretero, app. D).
struct EnumerationMethod {};

/// What a node runs for a pair: every niche followed, the search one stage among others.
struct TrackerMethod {
  TrackerParameters parameters;
  bool forgets = false;  ///< every instant is solved cold
};

/// Any algorithm of the thesis, and this package's own tracker.
using Method = std::variant<SearchMethod, ContinuousGeneticParameters, ContinuousAnnealingParameters,
                            TrackerMethod, EnumerationMethod>;

/// {cont|comb}-{GA|SA}-{wl|nl}..., see search/search_method.h; tracker; enumeration.
std::string nameOf(const Method& method);

/// Of a GA along a motion; other searches start anew at every instant.
struct MotionOptions {
  FirstGuess guess;
  std::optional<SearchMethod> further;  ///< what searches at all instants but the first; empty: the same
};

/// A row of a table: one algorithm with one set of parameters.
struct ExperimentRow {
  std::string name;
  RowBase base = RowBase::Thesis;
  Method method;
  bool has_own_limit = false;  ///< of evaluations, which a scene's does not replace
  MotionOptions motion;

  /// With what the scene wants.
  Method methodOn(const ExperimentScene& scene) const;
};

/// One table or figure: every row on every scene, many times. Read from thesis/experiments/*.yaml.
struct Experiment {
  std::string name;  ///< of the file, without its ending
  std::string title;
  std::uint64_t seed = 1;
  std::uint32_t quick_runs = 1;
  std::uint32_t full_runs = 1;
  bool niches = false;  ///< recall and precision of the final population are measured as well
  /// Of the niches, the visible ones alone count, which are those that a tracker lists.
  bool visible_niches = false;
  bool curves = false;             ///< averages over the generations are kept
  bool points = false;             ///< the best points of the final populations are kept
  bool population_points = false;  ///< every individual of the first run's final populations is kept
  std::vector<ExperimentScene> scenes;
  std::vector<ExperimentRow> rows;
};

/// @throws Error naming file, line and what is allowed
Experiment loadExperiment(const std::string& file);

}  // namespace concave_distance::evaluation
