#include "set_effects.h"

#include "concave_distance/base/error.h"
#include "effects_reader.h"
#include "scene/matching_pairs.h"
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
  std::vector<std::string> names;
  for (const std::size_t i : detail::matchingPairs(scene, pattern)) {
    ScenePair& pair = scene.pairs.edit(i);
    names.push_back(pair.name);
    detail::readEffects(value, pair.settings.effects);
    detail::validatePairSettings(pair.settings, "pair '" + pair.name + "'");
  }
  return names;
}

}  // namespace concave_distance
