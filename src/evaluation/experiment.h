#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "concave_distance/continuous/continuous_parameters.h"
#include "concave_distance/search/search_method.h"

namespace concave_distance::evaluation {

/// Any algorithm of the thesis.
using Method = std::variant<SearchMethod, ContinuousGeneticParameters, ContinuousAnnealingParameters>;

/// {cont|comb}-{GA|SA}-{wl|nl}..., see search/search_method.h.
std::string nameOf(const Method& method);

/// A row of a table: one algorithm with one set of parameters.
struct ExperimentRow {
  std::string name;
  Method method;
};

/// A scene of meshes/thesis at a pose, on a grid.
struct ExperimentScene {
  std::string name;        ///< of a poses file, e.g. battery_static
  double max_edge_length;  ///< metres
};

/// One table or figure: every row on every scene, many times. Read from experiments/*.yaml.
struct Experiment {
  std::string name;  ///< of the file, without its ending
  std::string title;
  std::uint64_t seed = 1;
  std::uint32_t quick_runs = 1;
  std::uint32_t full_runs = 1;
  bool niches = false;  ///< recall and precision of the final population are measured as well
  bool curves = false;  ///< averages over the generations are kept
  std::vector<ExperimentScene> scenes;
  std::vector<ExperimentRow> rows;
};

/// @throws Error naming file, line and what is allowed
Experiment loadExperiment(const std::string& file);

/// What the thesis's algorithm is without what this package has added to it: no exchange of genes, no
/// immigrants, niches are not conserved, no softening of the fitness. One elite stays (THESIS.md: universal
/// sampling can lose the best).
GeneticParameters thesisGeneticParameters();

}  // namespace concave_distance::evaluation
