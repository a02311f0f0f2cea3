#include "settings_reader.h"

#include <limits>

#include "concave_distance/base/error.h"
#include "effects_reader.h"
#include "search_settings_reader.h"
#include "setting_values.h"

namespace concave_distance::detail {
namespace {

constexpr std::pair<const char*, AccuracyLevel> kAccuracyLevels[] = {{"nodes", AccuracyLevel::Nodes},
                                                                     {"refined", AccuracyLevel::Refined},
                                                                     {"certified", AccuracyLevel::Certified},
                                                                     {"complete", AccuracyLevel::Complete}};
void readTrackerParameters(YamlMap& map, TrackerParameters& p) {
  if (auto v = map.take("accuracy")) p.accuracy = v->choice(kAccuracyLevels);
  if (auto v = map.take("absolute_tolerance")) {
    p.absolute_tolerance = v->number("0 or more, metres", notNegativeFinite);
  }
  if (auto v = map.take("relative_tolerance")) p.relative_tolerance = v->number(kShare, share);
  if (auto v = map.take("time_budget")) {
    p.time_budget = v->number("greater than 0, seconds; .inf for none", [](double s) { return s > 0.0; });
  }
  if (auto v = map.take("memory_limit")) {
    p.memory_limit = v->count(std::uint64_t{1} << 20U, std::numeric_limits<std::size_t>::max());
  }
  if (auto v = map.take("cutoff")) {
    p.cutoff = v->number("greater than 0, metres; .inf for none", [](double c) { return c > 0.0; });
  }
  if (auto v = map.take("least_prominence")) p.least_prominence = v->number("0 or more", notNegativeFinite);
  if (auto v = map.take("prominence_limit")) {
    p.prominence_limit = v->number("0 or more; .inf for all", [](double x) { return x >= 0.0; });
  }
  if (auto v = map.take("largest_niche_count")) p.largest_niche_count = count32(*v, 1);
  if (auto v = map.take("keep_through_material")) p.keep_through_material = v->boolean();
  if (auto v = map.take("inherited_per_niche")) {
    p.inherited_per_niche = v->number("1 or more", [](double n) { return n >= 1.0 && std::isfinite(n); });
  }
  if (auto v = map.take("inherited_limit")) p.inherited_limit = count32(*v, 0);
  if (auto v = map.take("immigrants")) p.immigrants = count32(*v, 0);
  if (auto v = map.take("search_motion")) p.search_motion = v->number("0 or more", notNegativeFinite);
  if (auto v = map.take("search_interval")) p.search_interval = count32(*v, 1);
  if (auto v = map.take("swept_cones")) p.swept_cones = count32(*v, 0);
  if (auto v = map.take("reviewed_niches")) p.reviewed_niches = count32(*v, 0);
  if (auto v = map.take("projected_niches")) p.projected_niches = count32(*v, 0);
  if (auto v = map.take("projected_immigrants")) p.projected_immigrants = count32(*v, 0);
  if (auto v = map.take("extrapolate")) p.extrapolate = v->boolean();
  if (auto v = map.take("seed")) p.seed = v->count(0, std::numeric_limits<std::uint64_t>::max());
  // Before cold and warm, whose own radii win.
  YamlMap copy = map;
  readNicheRadii(map, p.cold);
  readNicheRadii(copy, p.warm);
  if (auto v = map.take("cold")) readGeneticParameters(*v, p.cold);
  if (auto v = map.take("warm")) readGeneticParameters(*v, p.warm);
}

}  // namespace

void readPairSettings(YamlMap& map, PairSettings& settings) {
  readTrackerParameters(map, settings.tracker);
  if (auto v = map.take("warning_distance")) {
    settings.warning_distance = optionalNumber(*v, "never", "0 or more, metres", notNegativeFinite);
  }
  if (auto v = map.take("effects")) readEffects(*v, settings.effects);
  if (auto v = map.take("warning_hysteresis")) {
    settings.warning_hysteresis = v->number("0 or more, metres", notNegativeFinite);
  }
}

void validatePairSettings(const PairSettings& settings, const std::string& where) {
  settings.tracker.validate(where);
  settings.effects.validate(where + ".effects");
  if (settings.effects.any() && !provesDistance(settings.tracker.accuracy)) {
    throw Error(where,
                "effects are asked for at accuracy " + std::string(toString(settings.tracker.accuracy)) +
                    ", which does not prove that bodies are apart",
                "set accuracy to certified or complete, or effects to none");
  }
  if (settings.warning_distance && *settings.warning_distance > settings.tracker.cutoff) {
    throw Error(where,
                "warning_distance " + std::to_string(*settings.warning_distance) +
                    " m is beyond the cutoff of " + std::to_string(settings.tracker.cutoff) + " m",
                "nothing is computed there: raise cutoff or lower warning_distance");
  }
}

std::optional<double> readEdgeLength(const YamlValue& value) {
  return optionalNumber(value, "auto", kLength, positiveFinite);
}

double readLength(const YamlValue& value) {
  return value.number(kLength, positiveFinite);
}

}  // namespace concave_distance::detail
