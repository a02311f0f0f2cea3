#include "set_effects.h"

#include "concave_distance/base/error.h"
#include "contact/contact_parameter_tables.h"
#include "effects_reader.h"
#include "scene/apply_operations.h"
#include "settings_reader.h"
#include "yaml_text.h"

namespace concave_distance {
namespace detail {
namespace {

// Ten times a text with every key; it also limits how deep a text from outside can nest.
constexpr std::size_t kLongestEffects = 4096;

/// The model, and the parameters that belong to it.
template <typename Settings>
std::string modelText(const ParameterTable<Settings>& table, const Settings& settings) {
  const std::string model = concave_distance::toText(findParameter(table, "model")->get(settings));
  YamlItems items;
  for (const Parameter<Settings>& parameter : table) {
    if (parameter.info.name == "model" || belongsTo(parameter.info, model))
      items.add(parameter.info.name, concave_distance::toText(parameter.get(settings)));
  }
  return items.flow();
}

}  // namespace

SceneOperation effectsOperation(const std::string& pattern, const std::string& yaml,
                                const std::string& where) {
  if (yaml.size() > kLongestEffects) {
    throw Error(where, "the text has " + std::to_string(yaml.size()) + " characters",
                "allowed: at most " + std::to_string(kLongestEffects));
  }
  SceneOperation operation;
  operation.kind = OperationKind::SetEffects;
  operation.pair = pattern;
  operation.effects = yaml;
  operation.lay_effects = [value = YamlValue::parse(yaml, where)](const std::string& pair,
                                                                  PairSettings& settings) {
    readEffects(value, settings.effects);
    validatePairSettings(settings, pair);
  };
  return operation;
}

std::string effectsText(const EffectSettings& effects) {
  if (effects == EffectSettings()) return "none";
  YamlItems items;
  items.add("interference", effects.interference ? "true" : "false");
  items.add("normal_force",
            effects.normal_force ? modelText(normalForceParameters(), *effects.normal_force) : "none");
  const bool has_friction = effects.friction.model != FrictionModel::None;
  items.add("friction", has_friction ? modelText(frictionParameters(), effects.friction) : "none");
  return items.flow();
}

}  // namespace detail

std::vector<std::string> setEffects(Scene& scene, const std::string& pattern, const std::string& yaml) {
  return detail::applyOperation(scene, detail::effectsOperation(pattern, yaml, "effects"), {});
}

}  // namespace concave_distance
