#include "saved_settings.h"

#include <algorithm>

#include "contact/contact_parameter_tables.h"
#include "scene/pair_parameters.h"
#include "search/genetic_parameter_table.h"

namespace concave_distance::detail {
namespace {

std::string valueText(const ParameterValue& value) {
  const auto* number = std::get_if<double>(&value);
  return number != nullptr ? yamlNumber(*number) : concave_distance::toText(value);
}

/// @param part gives the settings that the table is of
template <typename Settings, typename Part>
void addParameters(const ParameterTable<Settings>& table, bool is_expert, const PairSettings& settings,
                   const std::vector<const PairSettings*>& bases, const Part& part, YamlItems& items) {
  for (const Parameter<Settings>& parameter : table) {
    if (parameter.info.is_expert != is_expert) continue;
    const ParameterValue value = parameter.get(part(settings));
    const bool is_known =
        !bases.empty() && std::all_of(bases.begin(), bases.end(), [&](const PairSettings* base) {
          return parameter.get(part(*base)) == value;
        });
    if (!is_known) items.add(parameter.info.name, valueText(value));
  }
}

/// The model, and the parameters that belong to it.
template <typename Settings>
std::string savedModel(const ParameterTable<Settings>& table, const Settings& settings) {
  const std::string model = concave_distance::toText(findParameter(table, "model")->get(settings));
  YamlItems items;
  for (const Parameter<Settings>& parameter : table) {
    if (parameter.info.name == "model" || belongsTo(parameter.info, model))
      items.add(parameter.info.name, valueText(parameter.get(settings)));
  }
  return items.flow();
}

std::string savedEffects(const EffectSettings& effects) {
  if (effects == EffectSettings()) return "none";
  YamlItems items;
  items.add("interference", effects.interference ? "true" : "false");
  items.add("normal_force",
            effects.normal_force ? savedModel(normalForceParameters(), *effects.normal_force) : "none");
  const bool has_friction = effects.friction.model != FrictionModel::None;
  items.add("friction", has_friction ? savedModel(frictionParameters(), effects.friction) : "none");
  return items.flow();
}

}  // namespace

void addSettings(const PairSettings& settings, const std::vector<const PairSettings*>& bases,
                 YamlItems& items) {
  const auto whole = [](const PairSettings& s) -> const PairSettings& { return s; };
  const auto cold = [](const PairSettings& s) -> const GeneticParameters& { return s.tracker.cold; };
  const auto warm = [](const PairSettings& s) -> const GeneticParameters& { return s.tracker.warm; };
  addParameters(pairParameters(), false, settings, bases, whole, items);
  const bool has_effects = bases.empty()
                               ? settings.effects != EffectSettings()
                               : std::any_of(bases.begin(), bases.end(), [&](const PairSettings* base) {
                                   return base->effects != settings.effects;
                                 });
  if (has_effects) items.add("effects", savedEffects(settings.effects));
  YamlItems expert;
  addParameters(pairParameters(), true, settings, bases, whole, expert);
  YamlItems of_cold;
  addParameters(geneticParameters(), false, settings, bases, cold, of_cold);
  if (!of_cold.empty()) expert.add("cold", of_cold.flow());
  YamlItems of_warm;
  addParameters(geneticParameters(), false, settings, bases, warm, of_warm);
  if (!of_warm.empty()) expert.add("warm", of_warm.flow());
  if (!expert.empty()) items.add("expert", expert.flow());
}

std::string savedMaterial(const Material& material) {
  YamlItems items;
  for (const Parameter<Material>& parameter : materialParameters())
    items.add(parameter.info.name, valueText(parameter.get(material)));
  return items.flow();
}

bool haveEqualValues(const Material& l, const Material& r) {
  const ParameterTable<Material>& table = materialParameters();
  return std::all_of(table.begin(), table.end(),
                     [&](const auto& parameter) { return parameter.get(l) == parameter.get(r); });
}

}  // namespace concave_distance::detail
