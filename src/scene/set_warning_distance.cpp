#include "set_warning_distance.h"

#include <cmath>

#include "base/number_text.h"
#include "concave_distance/base/error.h"
#include "matching_pairs.h"

namespace concave_distance {
namespace {

void requireLength(const std::string& field, double value) {
  if (!(value >= 0.0) || !std::isfinite(value)) {
    throw Error(field, "the value is " + numberText(value), "give metres: a finite number, 0 or more");
  }
}

}  // namespace

std::vector<std::string> setWarningDistance(Scene& scene, const std::string& pattern,
                                            std::optional<double> distance, double hysteresis) {
  if (distance) {
    requireLength("warning_distance", *distance);
    requireLength("warning_hysteresis", hysteresis);
  }
  std::vector<std::string> names;
  for (const std::size_t i : detail::matchingPairs(scene, pattern)) {
    names.push_back(scene.pairs[i].name);
    PairSettings& settings = scene.pairs.edit(i).settings;
    settings.warning_distance = distance;
    if (distance) settings.warning_hysteresis = hysteresis;
  }
  return names;
}

}  // namespace concave_distance
