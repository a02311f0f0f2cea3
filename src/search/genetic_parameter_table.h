#pragma once

#include "base/parameter.h"
#include "concave_distance/search/genetic_parameters.h"

namespace concave_distance {

/// The parameters of the genetic algorithm: files, messages and documents are made from it.
const ParameterTable<GeneticParameters>& geneticParameters();

}  // namespace concave_distance
