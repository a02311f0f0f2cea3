#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiment.h"

namespace concave_distance::evaluation {

/// Name and value of a parameter, as a file would have them.
using RowParameter = std::pair<std::string, std::string>;

/// Every parameter that a row runs with on a scene: what its method reads, defaults included, and of a GA
/// along a motion what each instant inherits. Of a tracker: what differs from the shipped ones, `cold.` and
/// `warm.` before those of its searches.
std::vector<RowParameter> rowParameters(const ExperimentRow& row, const ExperimentScene& scene);

/// Writes `<folder>/<experiment>_rows.csv`: row, algorithm, scene and its parameters, `name=value` with "; "
/// between. @throws Error when it cannot be written
void writeRows(const Experiment& experiment, const std::string& folder);

}  // namespace concave_distance::evaluation
