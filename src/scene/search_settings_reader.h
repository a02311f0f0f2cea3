#pragma once

#include "concave_distance/search/genetic_parameters.h"
#include "yaml_value.h"

namespace concave_distance::detail {

/// The three radii of niching, which settings may give for cold and warm cycles at once.
void readNicheRadii(YamlMap& map, GeneticParameters& parameters);

/// Sets what the map says and leaves the rest.
/// @throws Error for an unknown key, a wrong type or a value out of range
void readGeneticParameters(const YamlValue& value, GeneticParameters& parameters);
/// @throws Error for another word than those of `descent_moves`
DescentMoves readDescentMoves(const YamlValue& value);

}  // namespace concave_distance::detail
