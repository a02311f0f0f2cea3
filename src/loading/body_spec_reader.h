#pragma once

#include <optional>

#include "effects_reader.h"
#include "scene_spec.h"
#include "yaml_value.h"

namespace concave_distance::detail {

/// Holds what a scene file's `defaults` say about bodies and robots.
struct BodyDefaults {
  GeometrySource geometry = GeometrySource::Collision;
  std::optional<double> max_edge_length;
  std::optional<double> chord_error;
  Materials materials;
  Material material;
};

/// Returns a text that is no pattern. @throws Error naming the value
std::string readPlainText(const YamlValue& value);

/// Checks a name, or a part of one, that may be part of a topic's name. @throws Error naming the value
void requirePairName(const YamlValue& value, const std::string& name);

/// Takes the keys about bodies from `defaults`; the caller calls finish().
void readBodyDefaults(YamlMap& map, BodyDefaults& defaults);

/// Takes a body's `label`, `colour` and `margin`; the caller calls finish().
void readLooks(YamlMap& map, BodySpec& body);

/// One entry of `robots`. @throws Error for what is wrong with it
RobotSpec readRobotSpec(const YamlValue& value, const BodyDefaults& defaults);

/// One entry of `bodies`. @throws Error for what is wrong with it
BodySpec readBodySpec(const YamlValue& value, const BodyDefaults& defaults);

}  // namespace concave_distance::detail
