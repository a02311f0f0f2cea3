#pragma once

#include "first_guess.h"
#include "loading/yaml_value.h"
#include "search_method.h"

namespace concave_distance::evaluation {

/// What the map says of `inheritance`; the rest as in `guess`.
/// @throws Error for an unknown key, a wrong type or a value out of range
FirstGuess readFirstGuess(const detail::YamlValue& value, FirstGuess guess);

/// @throws Error for an unknown key, a wrong type or a value out of range
void readCombGa(const detail::YamlValue& value, CombGaParameters& parameters);

/// The islands' own parameters and, in `genetic`, those of the algorithm that runs on them.
/// @throws Error for an unknown key, a wrong type or a value out of range
void readIslands(const detail::YamlValue& value, IslandParameters& parameters);

/// @throws Error for an unknown key, a wrong type or a value out of range
void readMultiStart(const detail::YamlValue& value, MultiStartParameters& parameters);

}  // namespace concave_distance::evaluation
