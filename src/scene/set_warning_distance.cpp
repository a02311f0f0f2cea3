#include "set_warning_distance.h"

#include <cmath>

#include "base/number_text.h"
#include "concave_distance/base/error.h"
#include "rule_edits.h"

namespace concave_distance {
namespace {

void requireLength(const std::string& field, double value) {
  if (!(value >= 0.0) || !std::isfinite(value)) {
    throw Error(field, "the value is " + numberText(value), "give metres: a finite number, 0 or more");
  }
}

}  // namespace

void requireWarningWithinCutoff(const PairSettings& settings, const std::string& where) {
  if (settings.warning_distance && *settings.warning_distance > settings.tracker.cutoff) {
    throw Error(where,
                "warning_distance " + numberText(*settings.warning_distance) + " m is beyond the cutoff of " +
                    numberText(settings.tracker.cutoff) + " m",
                "nothing is computed there: raise cutoff or lower warning_distance");
  }
}

std::vector<std::string> setWarningDistance(Scene& scene, const std::string& pattern,
                                            std::optional<double> distance, double hysteresis) {
  if (distance) {
    requireLength("warning_distance", *distance);
    requireLength("warning_hysteresis", hysteresis);
  }
  return detail::changeMatchingPairs(scene, pattern,
                                     [&](const std::string& where, bool&, PairSettings& settings) {
                                       settings.warning_distance = distance;
                                       if (distance) settings.warning_hysteresis = hysteresis;
                                       requireWarningWithinCutoff(settings, where);
                                     });
}

}  // namespace concave_distance
