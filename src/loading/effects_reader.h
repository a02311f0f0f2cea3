#pragma once

#include <map>
#include <string>

#include "concave_distance/contact/effect_settings.h"
#include "concave_distance/contact/material.h"
#include "yaml_value.h"

namespace concave_distance::detail {

/// `effects` of a pair: `none`, or a map laid over `effects`: interference, normal_force, friction; the last
/// two a model's name, `none`, or a map with `model` and its parameters.
/// @throws Error naming key, value seen and what is allowed
void readEffects(const YamlValue& value, EffectSettings& effects);

using Materials = std::map<std::string, Material>;

/// `materials` of a scene file: a map from a name to a material's values.
Materials readMaterials(const YamlValue& value);

/// A body's `material`: a name among `materials`, or a map of values.
Material readMaterial(const YamlValue& value, const Materials& materials);

}  // namespace concave_distance::detail
