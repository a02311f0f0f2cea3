#include "merged_rules.h"

#include <map>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "equal_settings.h"
#include "pair_parameters.h"

namespace concave_distance::detail {
namespace {

using Class = std::optional<std::uint32_t>;

/// The classes that a body has in the three scenes; nothing where it is not in one.
struct Classes {
  Class loaded;
  Class edited;
  Class fresh;
  bool operator<(const Classes& r) const {
    return std::tie(loaded, edited, fresh) < std::tie(r.loaded, r.edited, r.fresh);
  }
};

PairSettings merged(const PairSettings& loaded, const PairSettings& edited, const PairSettings& fresh) {
  PairSettings settings = fresh;
  for (const Parameter<PairSettings>& parameter : pairParameters()) {
    const ParameterValue value = parameter.get(edited);
    if (value != parameter.get(loaded)) parameter.set(settings, value);
  }
  if (edited.effects != loaded.effects) settings.effects = edited.effects;
  return settings;
}

template <typename T>
T merged(T loaded, T edited, T fresh) {
  return edited != loaded ? edited : fresh;
}

using Places = std::unordered_map<std::uint64_t, std::size_t>;

Places placesOf(const Scene& scene) {
  Places places;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) places.emplace(scene.bodies[i].serial, i);
  return places;
}

std::optional<std::size_t> placeIn(const Places& places, std::uint64_t serial) {
  const auto found = places.find(serial);
  return found == places.end() ? std::nullopt : std::optional<std::size_t>(found->second);
}

class Merge {
 public:
  Merge(const Scene& loaded, const Scene& edited, const Scene& fresh, Scene& scene)
      : loaded_(loaded),
        edited_(edited),
        fresh_(fresh),
        scene_(scene),
        in_loaded_(placesOf(loaded)),
        in_edited_(placesOf(edited)),
        in_fresh_(placesOf(fresh)),
        in_scene_(placesOf(scene)) {}

  void run() {
    scene_.defaults.pairs = merged(loaded_.defaults.pairs, edited_.defaults.pairs, fresh_.defaults.pairs);
    mergeClasses();
    mergeListed();
  }

 private:
  static Class classIn(const Scene& scene, const Places& places, std::uint64_t serial) {
    const std::optional<std::size_t> place = placeIn(places, serial);
    return place ? Class(scene.bodies[*place].pair_class) : std::nullopt;
  }

  // Class 0 stays that of bodies that services add and nothing names.
  void mergeClasses() {
    std::map<Classes, std::uint32_t> number{{{std::nullopt, 0U, std::nullopt}, 0U}};
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
      const std::uint64_t serial = scene_.bodies[i].serial;
      const Classes classes{classIn(loaded_, in_loaded_, serial), classIn(edited_, in_edited_, serial),
                            classIn(fresh_, in_fresh_, serial)};
      const auto place = number.emplace(classes, static_cast<std::uint32_t>(number.size())).first;
      scene_.bodies.edit(i).pair_class = place->second;
    }
    PairRules rules;
    rules.filtered = fresh_.rules.filtered;
    rules.classes = number.size();
    rules.table.assign(rules.classes * rules.classes, PairRule());
    rules.settings.assign(1, PairSettings());
    for (const auto& [earlier, row] : number) {
      for (const auto& [later, column] : number) rules.of(row, column) = ruleOf(earlier, later, rules);
    }
    scene_.rules = std::move(rules);
  }

  PairRule ruleOf(const Classes& earlier, const Classes& later, PairRules& rules) {
    const PairRule* loaded =
        earlier.loaded && later.loaded ? &loaded_.rules.of(*earlier.loaded, *later.loaded) : nullptr;
    const PairRule* edited =
        earlier.edited && later.edited ? &edited_.rules.of(*earlier.edited, *later.edited) : nullptr;
    const PairRule* fresh =
        earlier.fresh && later.fresh ? &fresh_.rules.of(*earlier.fresh, *later.fresh) : nullptr;
    PairRule rule;
    if (loaded != nullptr && edited != nullptr && fresh != nullptr) {
      rule.is_watched = merged(loaded->is_watched, edited->is_watched, fresh->is_watched);
      rule.is_enabled = merged(loaded->is_enabled, edited->is_enabled, fresh->is_enabled);
      rule.order = merged(loaded->order, edited->order, fresh->order);
    } else if (edited == nullptr && fresh == nullptr && later.edited) {
      rule = edited_.rules.of(0, *later.edited);  // of a body that it has not met yet
      edited = &edited_.rules.of(0, *later.edited);
    } else if (edited != nullptr || fresh != nullptr) {
      rule = edited != nullptr ? *edited : *fresh;
    }
    rule.settings = settingsFor(loaded, edited, fresh, rules);
    return rule;
  }

  std::uint32_t settingsFor(const PairRule* loaded, const PairRule* edited, const PairRule* fresh,
                            PairRules& rules) {
    static constexpr std::uint32_t kNone = 0xffffffffU;  // GCC 9 takes one without `static` for captured
    const auto of = [](const PairRule* rule) { return rule == nullptr ? kNone : rule->settings; };
    const bool is_all = loaded != nullptr && edited != nullptr && fresh != nullptr;
    const auto key = is_all              ? std::tuple(of(loaded), of(edited), of(fresh))
                     : edited != nullptr ? std::tuple(kNone, of(edited), kNone)
                                         : std::tuple(kNone, kNone, of(fresh));
    const auto [place, is_new] = settings_.emplace(key, 0U);
    if (!is_new) return place->second;
    const PairSettings settings =
        is_all
            ? merged(settingsOf(loaded_, *loaded), settingsOf(edited_, *edited), settingsOf(fresh_, *fresh))
        : edited != nullptr ? (edited->settings == 0 ? scene_.defaults.pairs : settingsOf(edited_, *edited))
        : fresh != nullptr  ? settingsOf(fresh_, *fresh)
                            : scene_.defaults.pairs;
    if (haveEqualSettings(settings, scene_.defaults.pairs)) return 0;
    rules.settings.push_back(settings);
    return place->second = static_cast<std::uint32_t>(rules.settings.size() - 1);
  }

  // Returns this pair in another scene, listed or by its rule.
  std::optional<ScenePair> sameIn(const Scene& scene, const Places& places, std::uint64_t a,
                                  std::uint64_t b) const {
    const auto place_a = placeIn(places, a);
    const auto place_b = placeIn(places, b);
    return place_a && place_b ? pairOf(scene, *place_a, *place_b) : std::nullopt;
  }

  static bool isListed(const Scene& scene, const Places& places, std::uint64_t a, std::uint64_t b) {
    const auto place_a = placeIn(places, a);
    const auto place_b = placeIn(places, b);
    return place_a && place_b && scene.pairs.find(*place_a, *place_b);
  }

  void mergeListed() {
    scene_.pairs = PairList();
    for (const ScenePair& pair : fresh_.pairs) {
      const std::uint64_t a = fresh_.bodies[pair.body_a].serial;
      const std::uint64_t b = fresh_.bodies[pair.body_b].serial;
      const auto loaded = sameIn(loaded_, in_loaded_, a, b);
      const auto edited = sameIn(edited_, in_edited_, a, b);
      list(pair, a, b, loaded && edited ? laidOver(pair, *loaded, *edited) : pair);
    }
    for (const ScenePair& pair : edited_.pairs) {
      const std::uint64_t a = edited_.bodies[pair.body_a].serial;
      const std::uint64_t b = edited_.bodies[pair.body_b].serial;
      // A pair that the file lists no more is gone.
      if (isListed(fresh_, in_fresh_, a, b) || isListed(loaded_, in_loaded_, a, b)) continue;
      const auto loaded = sameIn(loaded_, in_loaded_, a, b);
      const auto fresh = sameIn(fresh_, in_fresh_, a, b);
      if (loaded && isAs(pair, *loaded)) continue;  // listed for its topics alone
      list(pair, a, b, loaded && fresh ? laidOver(*fresh, *loaded, pair) : pair);
    }
  }

  static bool isAs(const ScenePair& pair, const ScenePair& rule) {
    return pair.enabled == rule.enabled && haveEqualSettings(pair.settings, rule.settings);
  }

  static ScenePair laidOver(const ScenePair& fresh, const ScenePair& loaded, const ScenePair& edited) {
    ScenePair pair = fresh;
    pair.enabled = merged(loaded.enabled, edited.enabled, fresh.enabled);
    pair.settings = merged(loaded.settings, edited.settings, fresh.settings);
    return pair;
  }

  // Under the name and with body A of `as`.
  void list(const ScenePair& as, std::uint64_t a, std::uint64_t b, ScenePair pair) {
    const auto place_a = placeIn(in_scene_, a);
    const auto place_b = placeIn(in_scene_, b);
    if (!place_a || !place_b || scene_.pairs.find(*place_a, *place_b)) return;
    pair.name = as.name;
    for (int copy = 2; scene_.pairs.find(pair.name); ++copy) pair.name = as.name + "_" + std::to_string(copy);
    pair.body_a = *place_a;
    pair.body_b = *place_b;
    scene_.pairs.push_back(std::move(pair));
  }

  const Scene& loaded_;
  const Scene& edited_;
  const Scene& fresh_;
  Scene& scene_;
  Places in_loaded_;
  Places in_edited_;
  Places in_fresh_;
  Places in_scene_;
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, std::uint32_t> settings_;
};

}  // namespace

void mergeRules(const Scene& loaded, const Scene& edited, const Scene& fresh, Scene& scene) {
  Merge(loaded, edited, fresh, scene).run();
}

}  // namespace concave_distance::detail
