#include "saved_rules.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "saved_settings.h"
#include "yaml_text.h"

namespace concave_distance::detail {
namespace {

std::string flag(bool value) {
  return value ? "true" : "false";
}

std::string savedListed(const Scene& scene, const ScenePair& pair) {
  const SceneBody& a = scene.bodies[pair.body_a];
  const SceneBody& b = scene.bodies[pair.body_b];
  const bool in_order = pair.body_a < pair.body_b;
  const PairRule& rule =
      scene.rules.of(in_order ? a.pair_class : b.pair_class, in_order ? b.pair_class : a.pair_class);
  YamlItems items;
  items.add("between", yamlTexts({a.name, b.name}));
  if (pair.name != a.pairLabel() + "/" + b.pairLabel()) items.add("name", yamlText(pair.name));
  if (!pair.enabled || !rule.is_enabled) items.add("enabled", flag(pair.enabled));
  // Filters decide whether the rule applies too.
  addSettings(pair.settings, {&scene.defaults.pairs, &settingsOf(scene, rule)}, items);
  return "  - " + items.flow() + "\n";
}

/// Bodies of classes with the same rules.
struct SavedClass {
  std::uint32_t number = 0;  ///< of one of its classes
  std::vector<std::size_t> bodies;
};

/// Says a rule but for who is body A.
struct SaidRule {
  std::string text;  ///< what an entry says besides its sides; empty: nothing
  bool is_watched = false;
  bool is_default = false;
  bool later_is_a = false;
  bool operator==(const SaidRule& r) const { return text == r.text && is_watched == r.is_watched; }
};

class RuleWriter {
 public:
  explicit RuleWriter(const Scene& scene) : scene_(scene) {
    for (const PairSettings& settings : scene.rules.settings) {
      YamlItems items;
      addSettings(settings, {&scene.defaults.pairs}, items);
      settings_.push_back(items.bare());
    }
    findClasses();
    uses_.assign(classes_.size(), 0);
  }

  std::string write() {
    std::string lines;
    for (std::size_t row = 0; row < classes_.size(); ++row) {
      for (std::size_t column = row; column < classes_.size(); ++column) lines += entriesOf(row, column);
    }
    return lines;
  }

 private:
  SaidRule said(std::uint32_t earlier, std::uint32_t later) const {
    const PairRule& rule = scene_.rules.of(earlier, later);
    SaidRule result;
    result.is_watched = rule.is_watched;
    result.later_is_a = rule.is_watched && rule.order == PairOrder::Later;
    if (!rule.is_watched) result.text += ", watched: false";
    if (!rule.is_enabled) result.text += ", enabled: false";
    if (rule.settings != 0 && !settings_[rule.settings].empty())
      result.text += ", " + settings_[rule.settings];
    result.is_default = !rule.is_watched && rule.is_enabled && result.text == ", watched: false";
    return result;
  }

  // Classes that have bodies, those with the same rows and columns as one.
  void findClasses() {
    std::vector<std::vector<std::size_t>> bodies(scene_.rules.classes);
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) bodies[scene_.bodies[i].pair_class].push_back(i);
    std::vector<std::uint32_t> used;
    for (std::uint32_t c = 0; c < bodies.size(); ++c) {
      if (!bodies[c].empty()) used.push_back(c);
    }
    std::map<std::string, int> number_of;
    const auto number = [&](std::uint32_t earlier, std::uint32_t later) {
      const SaidRule rule = said(earlier, later);
      return number_of.emplace(rule.text + (rule.later_is_a ? "l" : "e"), number_of.size()).first->second;
    };
    std::map<std::vector<int>, std::size_t> place_of;
    for (const std::uint32_t c : used) {
      std::vector<int> signature;
      for (const std::uint32_t other : used) {
        signature.push_back(number(c, other));
        signature.push_back(number(other, c));
      }
      const auto [place, is_new] = place_of.emplace(std::move(signature), classes_.size());
      if (is_new) classes_.push_back({c, {}});
      std::vector<std::size_t>& all = classes_[place->second].bodies;
      all.insert(all.end(), bodies[c].begin(), bodies[c].end());
    }
    for (SavedClass& one : classes_) std::sort(one.bodies.begin(), one.bodies.end());
  }

  bool occurs(std::size_t earlier, std::size_t later) const {
    return classes_[earlier].bodies.front() < classes_[later].bodies.back();
  }

  std::string entriesOf(std::size_t row, std::size_t column) {
    const SaidRule rule = said(classes_[row].number, classes_[column].number);
    const SaidRule turned = said(classes_[column].number, classes_[row].number);
    const bool has_rule = occurs(row, column);
    const bool has_turned = row != column && occurs(column, row);
    if (row == column) {
      if (!has_rule || rule.is_default) return "";
      return rule.later_is_a ? ordered(row, row, rule) : between(row, row, rule);
    }
    if (has_rule && has_turned &&
        !(rule == turned && (!rule.is_watched || rule.later_is_a != turned.later_is_a))) {
      std::string lines = rule.is_default ? "" : ordered(row, column, rule);
      if (!turned.is_default) lines += ordered(column, row, turned);
      return lines;
    }
    const SaidRule& one = has_rule ? rule : turned;
    if (one.is_default) return "";
    const bool row_is_a = has_rule ? !rule.later_is_a : turned.later_is_a;
    return row_is_a ? between(row, column, one) : between(column, row, one);
  }

  // A list that stands more often than once has an anchor.
  std::string side(std::size_t place) {
    const std::vector<std::size_t>& bodies = classes_[place].bodies;
    if (bodies.size() == scene_.bodies.size()) return "'*'";
    const std::string anchor = "class_" + std::to_string(place + 1);
    if (uses_[place]++ > 0) return "*" + anchor + " ";
    std::vector<std::string> names;
    for (const std::size_t body : bodies) names.push_back(scene_.bodies[body].name);
    return "&" + anchor + " " + yamlTexts(names);
  }

  std::string between(std::size_t a, std::size_t b, const SaidRule& rule) {
    const std::string first = side(a);
    return "  - {between: [" + first + ", " + side(b) + "]" + rule.text + "}\n";
  }

  std::string ordered(std::size_t earlier, std::size_t later, const SaidRule& rule) {
    const std::string first = side(earlier);
    return "  - {earlier: " + first + ", later: " + side(later) + (rule.later_is_a ? ", body_a: later" : "") +
           rule.text + "}\n";
  }

  const Scene& scene_;
  std::vector<std::string> settings_;  ///< by PairRule::settings
  std::vector<SavedClass> classes_;
  std::vector<int> uses_;  ///< of their anchors
};

}  // namespace

std::string savedPairs(const Scene& scene) {
  std::string lines;
  for (const ScenePair& pair : scene.pairs) lines += savedListed(scene, pair);
  lines += RuleWriter(scene).write();
  return lines.empty() ? "pairs: []\n" : "pairs:\n" + lines;
}

}  // namespace concave_distance::detail
