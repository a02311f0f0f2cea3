#include "rule_edits.h"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <utility>

#include "concave_distance/base/error.h"
#include "equal_settings.h"
#include "name_pattern.h"
#include "pair_parameters.h"

namespace concave_distance::detail {
namespace {

/// What the bodies of one new class have in common.
struct ClassKey {
  std::uint32_t before = 0;
  bool on_a = false;
  bool on_b = false;
  bool is_link = false;
  bool operator<(const ClassKey& r) const {
    return std::tie(before, on_a, on_b, is_link) < std::tie(r.before, r.on_a, r.on_b, r.is_link);
  }
};

/// Builds the settings of new rules from those of the rules before, each once.
class NewSettings {
 public:
  explicit NewSettings(const Scene& scene) : scene_(scene), made_(1) {}
  void keep(PairRule& rule) {
    if (rule.settings == 0) return;
    const auto [place, is_new] = kept_.emplace(rule.settings, made_.size());
    if (is_new) made_.push_back(settingsOf(scene_, rule));
    rule.settings = static_cast<std::uint32_t>(place->second);
  }
  void change(PairRule& rule, const RuledBodies& bodies, const RuleChange& change) {
    const auto [place, is_new] = changed_.emplace(rule.settings, made_.size());
    PairSettings settings = settingsOf(scene_, rule);
    change(rule, settings, bodies);
    if (is_new) made_.push_back(settings);
    rule.settings = static_cast<std::uint32_t>(place->second);
  }
  std::vector<PairSettings> take() { return std::move(made_); }

 private:
  const Scene& scene_;
  std::vector<PairSettings> made_;
  std::map<std::uint32_t, std::size_t> kept_;
  std::map<std::uint32_t, std::size_t> changed_;
};

BodySide sideOf(const Scene& scene, const std::string& pattern) {
  BodySide side;
  for (const SceneBody& body : scene.bodies) side.push_back(matchesPattern(pattern, body.pairLabel()));
  return side;
}

bool isEmpty(const BodySide& side) {
  return std::find(side.begin(), side.end(), true) == side.end();
}

// The patterns of the two labels for each place where the slash between them may stand.
std::vector<std::array<std::string, 2>> patternsOfLabels(const std::string& given) {
  std::string pattern;
  for (const char c : given) {
    if (c != '*' || pattern.empty() || pattern.back() != '*') pattern += c;
  }
  std::vector<std::array<std::string, 2>> all;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    const std::string before = pattern.substr(0, i);
    const std::string after = pattern.substr(i + 1);
    if (pattern[i] == '/' || pattern[i] == '?') all.push_back({before, after});
    if (pattern[i] == '*') all.push_back({before + "*", "*" + after});
  }
  return all;
}

// Appends the names of the pairs by rule with a body on each side. @return whether there is one
bool appendNames(const Scene& scene, const BodySide& a, const BodySide& b, std::vector<std::string>& names) {
  const std::size_t before = names.size();
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; a[i] && j < b.size() && names.size() < kMostPairsNamed; ++j) {
      if (!b[j] || (j < i && a[j] && b[i])) continue;
      const auto pair = ruledPair(scene, i, j);
      if (pair && std::find(names.begin(), names.end(), pair->name) == names.end())
        names.push_back(pair->name);
    }
  }
  return names.size() > before;
}

}  // namespace

bool haveEqualSettings(const PairSettings& l, const PairSettings& r) {
  const auto& table = pairParameters();
  return l.effects == r.effects && std::all_of(table.begin(), table.end(), [&](const auto& parameter) {
           return parameter.get(l) == parameter.get(r);
         });
}

void changeRules(Scene& scene, const BodySide& side_a, const BodySide& side_b, const RuleChange& change) {
  std::map<ClassKey, std::uint32_t> classes = {{ClassKey(), 0}};
  std::vector<std::uint32_t> class_of_body;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const SceneBody& body = scene.bodies[i];
    const ClassKey key{body.pair_class, side_a[i], side_b[i], body.is_robot_link};
    class_of_body.push_back(classes.emplace(key, static_cast<std::uint32_t>(classes.size())).first->second);
  }
  PairRules rules;
  rules.filtered = scene.rules.filtered;
  rules.classes = classes.size();
  rules.table.resize(rules.classes * rules.classes);
  NewSettings settings(scene);
  for (const auto& [earlier, row] : classes) {
    for (const auto& [later, column] : classes) {
      PairRule& rule = rules.of(row, column) = scene.rules.of(earlier.before, later.before);
      const bool is_forwards = earlier.on_a && later.on_b;
      if (is_forwards || (earlier.on_b && later.on_a)) {
        settings.change(
            rule, {earlier.is_link && later.is_link, is_forwards ? PairOrder::Earlier : PairOrder::Later},
            change);
      } else {
        settings.keep(rule);
      }
    }
  }
  rules.settings = settings.take();
  for (std::size_t i = 0; i < class_of_body.size(); ++i) {
    if (scene.bodies[i].pair_class != class_of_body[i]) scene.bodies.edit(i).pair_class = class_of_body[i];
  }
  scene.rules = std::move(rules);
}

void takeOutEmptyClasses(Scene& scene) {
  constexpr std::size_t kFew = 16;
  if (scene.rules.classes <= kFew) return;
  std::vector<bool> is_used(scene.rules.classes, false);
  for (const SceneBody& body : scene.bodies) is_used[body.pair_class] = true;
  const auto used = static_cast<std::size_t>(std::count(is_used.begin(), is_used.end(), true));
  if (2 * used > scene.rules.classes) return;
  const BodySide nobody(scene.bodies.size(), false);
  changeRules(scene, nobody, nobody, [](PairRule&, PairSettings&, const RuledBodies&) {});
}

std::uint32_t classOfAdded(Scene& scene, const PairSettings& settings) {
  if (haveEqualSettings(settings, scene.defaults.pairs)) return 0;
  PairRules& rules = scene.rules;
  const auto is_it = [&](std::size_t column) {
    const PairRule& first = rules.of(0, column);
    if (first.settings == 0 || !haveEqualSettings(settings, rules.settings[first.settings])) return false;
    for (std::size_t row = 0; row < rules.classes; ++row) {
      const PairRule& rule = rules.of(row, column);
      if (rule.is_watched || !rule.is_enabled || rule.settings != first.settings) return false;
    }
    return true;
  };
  for (std::size_t column = 1; column < rules.classes; ++column) {
    if (is_it(column)) return static_cast<std::uint32_t>(column);
  }
  PairRules more;
  more.filtered = rules.filtered;
  more.settings = rules.settings;
  if (more.settings.empty()) more.settings.emplace_back();
  more.settings.push_back(settings);
  more.classes = rules.classes + 1;
  more.table.resize(more.classes * more.classes);
  for (std::size_t row = 0; row < more.classes; ++row) {
    for (std::size_t column = 0; column < rules.classes; ++column) {
      more.of(row, column) = rules.of(row < rules.classes ? row : 0, column);
    }
    more.of(row, rules.classes).settings = static_cast<std::uint32_t>(more.settings.size() - 1);
  }
  rules = std::move(more);
  return static_cast<std::uint32_t>(rules.classes - 1);
}

std::vector<std::string> changeMatchingPairs(Scene& scene, const std::string& pattern,
                                             const PairChange& change) {
  requirePatternLength(pattern, "pair");
  if (!isPattern(pattern) && !scene.pairs.find(pattern)) {
    if (std::optional<ScenePair> named = findPairNamed(scene, pattern))
      scene.pairs.push_back(std::move(*named));
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    const bool is_named = scene.pairs[i].name == pattern;
    if (!is_named && !matchesPattern(pattern, scene.pairs[i].name)) continue;
    ScenePair& pair = scene.pairs.edit(i);
    if (is_named) pair.is_from_rule = false;
    change("pair '" + pair.name + "'", pair.enabled, pair.settings);
    names.push_back(pair.name);
  }
  if (isPattern(pattern)) {
    for (const auto& [before, after] : patternsOfLabels(pattern)) {
      const BodySide a = sideOf(scene, before);
      const BodySide b = isEmpty(a) ? BodySide() : sideOf(scene, after);
      if (isEmpty(b) || !appendNames(scene, a, b, names)) continue;
      changeRules(scene, a, b, [&](PairRule& rule, PairSettings& settings, const RuledBodies&) {
        change("pairs '" + pattern + "'", rule.is_enabled, settings);
      });
    }
  }
  if (names.empty()) {
    throw Error("pair", "there is no pair '" + pattern + "'",
                "list_bodies has their names; * matches any characters, ? one");
  }
  return names;
}

void listMatchingPairs(Scene& scene, const std::vector<std::string>& patterns) {
  for (const std::string& pattern : patterns) {
    if (!isPattern(pattern)) {
      if (scene.pairs.find(pattern)) continue;
      if (std::optional<ScenePair> pair = findPairNamed(scene, pattern))
        scene.pairs.push_back(std::move(*pair));
      continue;
    }
    for (const auto& [before, after] : patternsOfLabels(pattern)) {
      const BodySide a = sideOf(scene, before);
      const BodySide b = isEmpty(a) ? BodySide() : sideOf(scene, after);
      for (std::size_t i = 0; i < a.size() && !isEmpty(b); ++i) {
        for (std::size_t j = 0; a[i] && j < b.size(); ++j) {
          if (!b[j] || scene.pairs.size() >= scene.limits.pairs) continue;
          std::optional<ScenePair> pair = ruledPair(scene, i, j);
          if (pair && matchesPattern(pattern, pair->name)) scene.pairs.push_back(std::move(*pair));
        }
      }
    }
  }
}

}  // namespace concave_distance::detail
