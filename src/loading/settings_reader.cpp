#include "settings_reader.h"

#include <cmath>

#include "concave_distance/base/error.h"
#include "effects_reader.h"
#include "parameter_map.h"
#include "scene/pair_parameters.h"
#include "scene/set_warning_distance.h"
#include "search/genetic_parameter_table.h"

namespace concave_distance::detail {
namespace {

/// An expert's setting that stands among the others would only be called unknown.
void refuseExpertSettings(const YamlMap& map) {
  for (const auto& [key, value] : map.entries()) {
    const Parameter<PairSettings>* parameter = findParameter(pairParameters(), key);
    if (parameter == nullptr || !parameter->info.is_expert) continue;
    value.fail("'" + key + "' is a setting for experts", "write expert: {" + key + ": ...}");
  }
}

/// The radii of niching, which may be given for cold and warm cycles at once.
void readCommonRadii(YamlMap& map, TrackerParameters& tracker) {
  for (const char* name : {"sharing_radius", "mating_radius", "niche_radius"}) {
    const auto value = map.take(name);
    if (!value) continue;
    const Parameter<GeneticParameters>& radius = *findParameter(geneticParameters(), name);
    const ParameterValue read = readParameter(*value, radius.info);
    radius.set(tracker.cold, read);
    radius.set(tracker.warm, read);
  }
}

/// All that the map may hold; what it does not name stays.
void readGeneticParameters(const YamlValue& value, GeneticParameters& parameters) {
  YamlMap map(value, "a map of parameters of the genetic algorithm");
  readParameters(map, geneticParameters(), false, parameters);
  map.finish();
}

void readExpertSettings(const YamlValue& value, PairSettings& settings) {
  YamlMap map(value, "a map of settings for experts");
  readParameters(map, pairParameters(), true, settings);
  // Before cold and warm, whose own radii apply.
  readCommonRadii(map, settings.tracker);
  if (auto v = map.take("cold")) readGeneticParameters(*v, settings.tracker.cold);
  if (auto v = map.take("warm")) readGeneticParameters(*v, settings.tracker.warm);
  map.finish();
}

}  // namespace

void readPairSettings(YamlMap& map, PairSettings& settings) {
  refuseExpertSettings(map);
  readParameters(map, pairParameters(), false, settings);
  if (auto v = map.take("effects")) readEffects(*v, settings.effects);
  if (auto v = map.take("expert")) readExpertSettings(*v, settings);
}

void validatePairSettings(const PairSettings& settings, const std::string& where) {
  settings.tracker.validate(where);
  settings.effects.validate(where + ".effects");
  if (settings.effects.any() && !provesDistance(settings.tracker.accuracy)) {
    throw Error(where,
                "effects are asked for at accuracy " + std::string(toString(settings.tracker.accuracy)) +
                    ", which does not prove that bodies are apart",
                "set accuracy to certified, or effects to none");
  }
  requireWarningWithinCutoff(settings, where);
}

std::optional<double> readEdgeLength(const YamlValue& value) {
  return optionalNumber(value, "auto", kLength, positiveFinite);
}

double readLength(const YamlValue& value) {
  return value.number(kLength, positiveFinite);
}

double readLengthOrZero(const YamlValue& value) {
  return value.number("a number from 0, metres",
                      [](double length) { return length >= 0.0 && std::isfinite(length); });
}

}  // namespace concave_distance::detail
