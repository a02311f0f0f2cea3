#pragma once

#include "base/parameter.h"
#include "concave_distance/search/genetic_parameters.h"

namespace concave_distance {

/// The parameters of the genetic algorithm that a scene file and the node have: files, messages and documents
/// are made from it.
const ParameterTable<GeneticParameters>& geneticParameters();

/// Those of experiments too.
const ParameterTable<GeneticParameters>& allGeneticParameters();

}  // namespace concave_distance
