#include "rule_edits.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "concave_distance/base/error.h"
#include "equal_settings.h"
#include "name_pattern.h"
#include "pair_parameters.h"
#include "search/genetic_parameter_table.h"

namespace concave_distance::detail {
namespace {

bool hasPairs(const PairRule& rule) {
  return !rule.earlier.empty() && !rule.later.empty() && rule.earlier.first() < rule.later.last();
}

// Returns whether one of the rules from `next` on holds all pairs of a rule, so that it decides none.
bool isHidden(const PairRule& rule, const std::vector<PairRule>& list, std::size_t next) {
  for (std::size_t i = next; i < list.size(); ++i) {
    if (rule.earlier.isWithin(list[i].earlier) && rule.later.isWithin(list[i].later)) return true;
  }
  return false;
}

bool sayTheSame(const PairRule& l, const PairRule& r) {
  return l.is_watched == r.is_watched && l.is_enabled == r.is_enabled && l.order == r.order;
}

// Joins a rule with the one before it if one can say both.
bool joinRules(PairRule& before, const PairRule& rule) {
  if (!sayTheSame(before, rule) || before.settings != rule.settings) return false;
  if (before.later == rule.later) {
    before.earlier |= rule.earlier;
  } else if (before.earlier == rule.earlier) {
    before.later |= rule.later;
  } else {
    return false;
  }
  return true;
}

// Takes out rules that decide no pair, and settings that no rule gives.
void tidy(PairRules& rules) {
  std::vector<PairRule> list;
  for (std::size_t i = 0; i < rules.list.size(); ++i) {
    PairRule& rule = rules.list[i];
    if (!hasPairs(rule) || isHidden(rule, rules.list, i + 1)) continue;
    if (list.empty() || !joinRules(list.back(), rule)) list.push_back(std::move(rule));
  }
  std::vector<PairSettings> settings(1);
  std::map<std::uint32_t, std::uint32_t> kept{{0, 0}};
  for (PairRule& rule : list) {
    const auto [place, is_new] = kept.emplace(rule.settings, static_cast<std::uint32_t>(settings.size()));
    if (is_new) settings.push_back(std::move(rules.settings[rule.settings]));
    rule.settings = place->second;
  }
  rules.list = std::move(list);
  rules.settings = std::move(settings);
}

/// Changes each rule for some of its pairs.
class RuleParts {
 public:
  RuleParts(Scene& scene, const BodySet& earlier, const BodySet& later, PairOrder order,
            const RuleChange& change)
      : scene_(scene), earlier_(earlier), later_(later), order_(order), change_(change) {
    if (scene.rules.settings.empty()) scene.rules.settings.emplace_back();
  }

  // The changed part of a rule comes right behind it, so that it has its place among the others.
  void run() {
    const BodySet all = BodySet::before(scene_.bodies.size());
    PairRule none;
    none.earlier = none.later = all;
    addPart(none, 0);
    const std::vector<PairRule>& list = scene_.rules.list;
    for (std::size_t i = 0; i < list.size(); ++i) {
      const bool is_whole = list[i].earlier.isWithin(earlier_) && list[i].later.isWithin(later_);
      if (!is_whole) next_.push_back(list[i]);
      addPart(list[i], i + 1);
    }
    scene_.rules.list = std::move(next_);
    tidy(scene_.rules);
  }

 private:
  void addPart(const PairRule& rule, std::size_t next) {
    PairRule part = rule;
    part.earlier = rule.earlier & earlier_;
    part.later = rule.later & later_;
    if (!hasPairs(part) || isHidden(part, scene_.rules.list, next)) return;
    PairSettings settings = settingsOf(scene_, rule);
    change_(part, settings, order_);
    if (!haveEqualSettings(settings, settingsOf(scene_, rule))) {
      std::vector<PairSettings>& all = scene_.rules.settings;
      const auto [place, is_new] = changed_.emplace(rule.settings, static_cast<std::uint32_t>(all.size()));
      if (is_new) all.push_back(std::move(settings));
      part.settings = place->second;
    }
    next_.push_back(std::move(part));
  }

  Scene& scene_;
  const BodySet& earlier_;
  const BodySet& later_;
  PairOrder order_;
  const RuleChange& change_;
  std::vector<PairRule> next_;
  std::map<std::uint32_t, std::uint32_t> changed_;  ///< settings of parts, by those of their rules
};

// Lets a new body have this rule, as one that says the same of bodies before it, where there is one.
void addRule(Scene& scene, std::size_t body, PairRule rule, const PairSettings& settings) {
  if (rule.earlier.empty()) return;
  const bool are_defaults = haveEqualSettings(settings, scene.defaults.pairs);
  for (PairRule& before : scene.rules.list) {
    const BodySet more = rule.earlier - before.earlier;
    const bool fits = sayTheSame(before, rule) && (before.settings == 0) == are_defaults &&
                      before.earlier.isWithin(rule.earlier) &&
                      (more.empty() || more.first() >= before.later.last());
    if (!fits || !(are_defaults || haveEqualSettings(settingsOf(scene, before), settings))) continue;
    before.earlier |= rule.earlier;
    before.later.insert(body);
    return;
  }
  if (!are_defaults) {
    if (scene.rules.settings.empty()) scene.rules.settings.emplace_back();
    rule.settings = static_cast<std::uint32_t>(scene.rules.settings.size());
    scene.rules.settings.push_back(settings);
  }
  rule.later.insert(body);
  scene.rules.list.push_back(std::move(rule));
}

BodySet sideOf(const Scene& scene, const std::string& pattern) {
  BodySet side;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (matchesPattern(pattern, scene.bodies[i].pairLabel())) side.insert(i);
  }
  return side;
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

// Visits the pairs by rule with a body on each side, each once, while `act` returns true.
template <typename Act>
void visitPairs(const Scene& scene, const BodySet& a, const BodySet& b, const Act& act) {
  const std::vector<std::size_t> others = b.indices();
  for (const std::size_t i : a.indices()) {
    for (const std::size_t j : others) {
      if (j < i && a.contains(j) && b.contains(i)) continue;
      std::optional<ScenePair> pair = ruledPair(scene, i, j);
      if (pair && !act(std::move(*pair))) return;
    }
  }
}

// Appends the names of the pairs by rule with a body on each side. @return whether there is one
bool appendNames(const Scene& scene, const BodySet& a, const BodySet& b, std::vector<std::string>& names) {
  bool is_any = false;
  visitPairs(scene, a, b, [&](const ScenePair& pair) {
    is_any = true;
    if (names.size() >= kMostPairsNamed) return false;
    if (std::find(names.begin(), names.end(), pair.name) == names.end()) names.push_back(pair.name);
    return true;
  });
  return is_any;
}

template <typename Settings>
bool areEqual(const ParameterTable<Settings>& table, const Settings& l, const Settings& r) {
  return std::all_of(table.begin(), table.end(),
                     [&](const auto& parameter) { return parameter.get(l) == parameter.get(r); });
}

}  // namespace

bool haveEqualSettings(const PairSettings& l, const PairSettings& r) {
  return l.effects == r.effects && areEqual(pairParameters(), l, r) &&
         areEqual(geneticParameters(), l.tracker.cold, r.tracker.cold) &&
         areEqual(geneticParameters(), l.tracker.warm, r.tracker.warm);
}

void changeRules(Scene& scene, const BodySet& side_a, const BodySet& side_b, const RuleChange& change) {
  changeOrderedRules(scene, side_a, side_b, PairOrder::Earlier, change);
  if (!(side_a == side_b)) changeOrderedRules(scene, side_b, side_a, PairOrder::Later, change);
}

void changeOrderedRules(Scene& scene, const BodySet& earlier, const BodySet& later, PairOrder order,
                        const RuleChange& change) {
  RuleParts(scene, earlier, later, order, change).run();
}

void addRulesOfNewBody(Scene& scene, const BodySet& partners, const PairSettings& settings) {
  const std::size_t body = scene.bodies.size() - 1;
  PairRule rule;
  rule.order = PairOrder::Later;
  if (!haveEqualSettings(settings, scene.defaults.pairs)) {
    rule.earlier = BodySet::before(body) - partners;
    addRule(scene, body, rule, settings);
  }
  rule.is_watched = true;
  rule.earlier = partners;
  addRule(scene, body, std::move(rule), settings);
}

void takeOutOfRules(PairRules& rules, const std::vector<bool>& gone) {
  for (PairRule& rule : rules.list) {
    rule.earlier.takeOut(gone);
    rule.later.takeOut(gone);
  }
  tidy(rules);
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
      const BodySet a = sideOf(scene, before);
      const BodySet b = a.empty() ? BodySet() : sideOf(scene, after);
      if (!appendNames(scene, a, b, names)) continue;
      changeRules(scene, a, b, [&](PairRule& rule, PairSettings& settings, PairOrder) {
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
      const BodySet a = sideOf(scene, before);
      visitPairs(scene, a, a.empty() ? BodySet() : sideOf(scene, after), [&](ScenePair pair) {
        if (scene.pairs.size() >= scene.limits.pairs) return false;
        if (matchesPattern(pattern, pair.name)) scene.pairs.push_back(std::move(pair));
        return true;
      });
    }
  }
}

}  // namespace concave_distance::detail
