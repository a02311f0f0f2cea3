#include "concave_distance/scene/set_effects.h"

#include "concave_distance/base/error.h"
#include "effects_reader.h"
#include "name_pattern.h"
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
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    const std::string& name = scene.pairs[i].name;
    if (name != pattern && !detail::matchesPattern(pattern, name)) continue;
    names.push_back(name);
    ScenePair& pair = scene.pairs.edit(i);
    detail::readEffects(value, pair.settings.effects);
    detail::validatePairSettings(pair.settings, "pair '" + pair.name + "'");
  }
  if (names.empty()) {
    throw Error("pair", "there is no pair '" + pattern + "'",
                "list_bodies has their names; * matches any characters, ? one");
  }
  return names;
}

}  // namespace concave_distance
