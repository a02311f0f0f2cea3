#include "set_effects.h"

#include "concave_distance/base/error.h"
#include "effects_reader.h"
#include "scene/rule_edits.h"
#include "settings_reader.h"

namespace concave_distance {
namespace {

// Ten times a text with every key; it also limits how deep a text from outside can nest.
constexpr std::size_t kLongestEffects = 4096;

}  // namespace

std::vector<std::string> setEffects(Scene& scene, const std::string& pattern, const std::string& yaml) {
  if (yaml.size() > kLongestEffects) {
    throw Error("effects", "the text has " + std::to_string(yaml.size()) + " characters",
                "allowed: at most " + std::to_string(kLongestEffects));
  }
  const detail::YamlValue value = detail::YamlValue::parse(yaml, "effects");
  return detail::changeMatchingPairs(scene, pattern,
                                     [&](const std::string& where, bool&, PairSettings& settings) {
                                       detail::readEffects(value, settings.effects);
                                       detail::validatePairSettings(settings, where);
                                     });
}

}  // namespace concave_distance
