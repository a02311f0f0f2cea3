#pragma once

#include <cstdint>
#include <optional>

#include "concave_distance/scene/scene.h"
#include "yaml_value.h"

namespace concave_distance::detail {

/// Who reads settings: what a node does not need, experiments have all the same.
enum class SettingsReader : std::uint8_t { Node, Experiment };

/// Sets what the map's keys say and leaves the rest, so that settings can be laid over one another. Takes
/// every key of pair settings from the map; the caller takes its own and calls finish().
/// @throws Error for a wrong type or a value out of range
void readPairSettings(YamlMap& map, PairSettings& settings, SettingsReader reader = SettingsReader::Node);

/// The same of the genetic algorithm's parameters, which are all that the map may hold.
/// @throws Error for an unknown key, a wrong type or a value out of range
void readGeneticParameters(const YamlValue& value, GeneticParameters& parameters,
                           SettingsReader reader = SettingsReader::Node);

/// Checks what only shows when all has been laid together. @throws Error naming `where`
void validatePairSettings(const PairSettings& settings, const std::string& where);

/// `max_edge_length`: metres, or auto (empty).
std::optional<double> readEdgeLength(const YamlValue& value);

/// A positive, finite length in metres.
double readLength(const YamlValue& value);

}  // namespace concave_distance::detail
