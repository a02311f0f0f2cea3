#pragma once

#include <optional>

#include "concave_distance/scene/scene.h"
#include "yaml_value.h"

namespace concave_distance::detail {

/// Sets what the map's keys say and leaves the rest, so that settings can be laid over one another. Takes
/// every key of pair settings from the map; the caller takes its own and calls finish().
/// @throws Error for a wrong type or a value out of range
void readPairSettings(YamlMap& map, PairSettings& settings);

/// Checks what only shows when all has been laid together. @throws Error naming `where`
void validatePairSettings(const PairSettings& settings, const std::string& where);

/// `max_edge_length`: metres, or auto (empty).
std::optional<double> readEdgeLength(const YamlValue& value);

/// A positive, finite length in metres.
double readLength(const YamlValue& value);
/// A finite length from 0 on, metres.
double readLengthOrZero(const YamlValue& value);

}  // namespace concave_distance::detail
