#include "effects_reader.h"

#include "concave_distance/base/error.h"
#include "contact/contact_parameter_tables.h"
#include "parameter_map.h"

namespace concave_distance::detail {
namespace {

/// A parameter of another model would change nothing.
template <typename Settings>
void refuseUnfit(const YamlMap& map, const ParameterTable<Settings>& table, const std::string& model) {
  for (const auto& [key, value] : map.entries()) {
    const Parameter<Settings>* parameter = findParameter(table, key);
    if (parameter == nullptr || belongsTo(parameter->info, model)) continue;
    value.fail("it is a parameter of " + modelsOf(parameter->info, "and") + ", and the model is " + model,
               "leave it out, or write model: " + modelsOf(parameter->info, "or"));
  }
}

/// A map of parameters, or the word of its parameter `model` alone.
template <typename Settings>
void readModel(const YamlValue& value, const ParameterTable<Settings>& table, Settings& settings) {
  const Parameter<Settings>& model = *findParameter(table, "model");
  if (!value.isMap()) {
    model.set(settings, readParameter(value, model.info));
    return;
  }
  YamlMap map(value, "a map with model and its parameters");
  if (const auto word = map.take("model")) model.set(settings, readParameter(*word, model.info));
  refuseUnfit(map, table, toText(model.get(settings)));
  readParameters(map, table, false, settings);
  map.finish();
}

void readNormalForce(const YamlValue& value, std::optional<NormalForceSettings>& normal_force) {
  if (value.isText("none")) {
    normal_force.reset();
    return;
  }
  NormalForceSettings settings = normal_force.value_or(NormalForceSettings());
  readModel(value, normalForceParameters(), settings);
  normal_force = settings;
}

Material readMaterialValues(const YamlValue& value) {
  YamlMap map(value, "a map of a material's values");
  Material material;
  readParameters(map, materialParameters(), false, material);
  map.finish();
  material.validate(value.where());
  return material;
}

}  // namespace

void readEffects(const YamlValue& value, EffectSettings& effects) {
  if (value.isText("none")) {
    effects = {};
    return;
  }
  if (!value.isMap()) value.refuse("none, or a map with interference, normal_force, friction");
  YamlMap map(value, "a map with interference, normal_force, friction");
  if (auto v = map.take("interference")) effects.interference = v->boolean();
  if (auto v = map.take("normal_force")) readNormalForce(*v, effects.normal_force);
  if (auto v = map.take("friction")) readModel(*v, frictionParameters(), effects.friction);
  map.finish();
  effects.validate(value.where());
}

Materials readMaterials(const YamlValue& value) {
  const YamlMap map(value, "a map from a material's name to its values");
  Materials materials;
  for (const auto& [name, values] : map.entries()) materials[name] = readMaterialValues(values);
  return materials;
}

Material readMaterial(const YamlValue& value, const Materials& materials) {
  if (value.isMap()) return readMaterialValues(value);
  std::string known;
  for (const auto& [name, material] : materials) {
    if (value.isText(name.c_str())) return material;
    known += (known.empty() ? "" : ", ") + name;
  }
  value.refuse((known.empty() ? "a name under `materials`, where there is none yet"
                              : "a name under `materials`: " + known) +
               "; or a map of a material's values");
}

}  // namespace concave_distance::detail
