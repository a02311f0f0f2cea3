#pragma once

#include "loading/yaml_value.h"
#include "thesis/src/annealing/annealing_parameters.h"

namespace concave_distance::detail {

/// Sets what the map says and leaves the rest.
/// @throws Error for an unknown key, a wrong type or a value out of range
void readAnnealingParameters(const YamlValue& value, AnnealingParameters& parameters);

}  // namespace concave_distance::detail
