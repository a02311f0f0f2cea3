#pragma once

#include <functional>
#include <optional>

#include "concave_distance/scene/scene.h"
#include "yaml_value.h"

namespace concave_distance::detail {

/// Reads the parameters of the genetic algorithm, which are all that the map may hold; what it does not name
/// stays. @throws Error for an unknown key, a wrong type or a value out of range
void readGeneticParameters(const YamlValue& value, GeneticParameters& parameters);

using GeneticReader = std::function<void(const YamlValue& value, GeneticParameters& parameters)>;

/// Sets what the map's keys say and leaves the rest, so that settings can be laid over one another. Takes
/// every key of pair settings from the map; the caller takes its own and calls finish().
/// @param read_genetic reads `cold` and `warm`; experiments have more parameters
/// @throws Error for a wrong type or a value out of range
void readPairSettings(YamlMap& map, PairSettings& settings,
                      const GeneticReader& read_genetic = readGeneticParameters);

/// Checks what only shows when all has been laid together. @throws Error naming `where`
void validatePairSettings(const PairSettings& settings, const std::string& where);

/// `max_edge_length`: metres, or auto (empty).
std::optional<double> readEdgeLength(const YamlValue& value);

/// A positive, finite length in metres.
double readLength(const YamlValue& value);
/// A finite length from 0 on, metres.
double readLengthOrZero(const YamlValue& value);

}  // namespace concave_distance::detail
