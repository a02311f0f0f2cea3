#include "select_pairs.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "base/ascii.h"
#include "body_selector.h"
#include "concave_distance/base/error.h"
#include "filtered_pairs.h"
#include "settings_reader.h"

namespace concave_distance::detail {
namespace {

using Side = std::vector<bool>;  // one entry each source

// Each once: what is taken gets a number. @throws Error for two that are given and the same
std::vector<std::string> labelsOf(const std::vector<BodySource>& sources) {
  std::set<std::string> taken;
  for (const BodySource& source : sources) {
    if (source.label.empty() || taken.insert(source.label).second) continue;
    throw Error(source.source, "the label '" + source.label + "' is taken by another body", "give another");
  }
  std::vector<std::string> labels;
  for (const BodySource& source : sources) {
    if (!source.label.empty()) {
      labels.push_back(source.label);
      continue;
    }
    const std::string wanted = bodyLabel(source.name);
    std::string label = wanted;
    for (int copy = 2; !taken.insert(label).second; ++copy) label = wanted + "_" + std::to_string(copy);
    labels.push_back(std::move(label));
  }
  return labels;
}

/// The two sides of an entry.
struct Sides {
  std::size_t number = 0;           ///< of the entry in the file
  const PairSpec* entry = nullptr;  ///< nullptr: of `disable`, or every body against every other
  Side a;
  Side b;

  bool isOrdered() const { return entry != nullptr && entry->is_ordered; }
  bool isWatched() const { return entry == nullptr || entry->is_watched; }
  bool hold(std::size_t source_a, std::size_t source_b) const { return a[source_a] && b[source_b]; }
  /// @param earlier the one of two sources that comes first
  bool holdPair(std::size_t earlier, std::size_t later) const {
    return hold(earlier, later) || (!isOrdered() && hold(later, earlier));
  }
  bool holdEitherWay(std::size_t source_a, std::size_t source_b) const {
    return hold(source_a, source_b) || hold(source_b, source_a);
  }
};

/// The entries that name both bodies of one pair.
struct NamedPair {
  std::size_t source_a = 0;
  std::size_t source_b = 0;
  std::size_t number = 0;  ///< of the first entry in the file
  std::vector<const PairSpec*> entries;
  bool is_disabled = false;
};

class Selection {
 public:
  Selection(const SceneSpec& spec, const SceneParts& parts, std::size_t pair_limit)
      : spec_(spec), parts_(parts), pair_limit_(pair_limit), selector_(parts, spec.groups, result_.notes) {}

  PairSelection run() {
    result_.labels = labelsOf(parts_.sources);
    result_.filtered = filteredPairs(parts_);
    if (spec_.pairs) {
      for (const PairSpec& entry : *spec_.pairs) addEntry(entry);
    } else {
      const Side all(parts_.sources.size(), true);
      general_.push_back({0, nullptr, all, all});
    }
    for (const auto& sides : spec_.disabled) disable(sides);
    makeRules();
    for (const BodySpec& body : spec_.bodies) addRuleOf(body);
    noteFilteredPairs(parts_, result_);
    for (const NamedPair& pair : named_) result_.pairs.push_back(settle(pair));
    for (const auto& [name, sources] : selector_.groups()) {
      std::vector<std::string>& members = result_.groups[name];
      for (const std::size_t source : sources) members.push_back(parts_.sources[source].name);
    }
    return std::move(result_);
  }

 private:
  Side sideOf(const std::vector<std::size_t>& sources) const {
    Side side(parts_.sources.size(), false);
    for (const std::size_t source : sources) side[source] = true;
    return side;
  }

  void addEntry(const PairSpec& entry) {
    ++entries_;
    if (entry.between[0].is_list || entry.between[1].is_list) {
      addListEntry(entry);
      return;
    }
    const Selector& first = entry.between[0].names.front();
    const Selector& second = entry.between[1].names.front();
    const BodySelector::Selection a = selector_.select(first);
    const BodySelector::Selection b = selector_.select(second);
    const std::string& where = first.where;
    if (a.is_lost || b.is_lost) {
      result_.problems.push_back(
          {where, "pairs of '" + first.text + "' and '" + second.text + "' are not served: '" +
                      (a.is_lost ? first : second).text +
                      "' is not known, perhaps it is of a robot that could not be read"});
      return;
    }
    if (!(a.names_one && b.names_one) || entry.is_ordered) {
      requireNoName(entry);
      const bool is_one_body = a.sources.size() == 1 && a.sources == b.sources;
      if (a.sources.empty() || b.sources.empty() || is_one_body) {
        result_.notes.push_back(where + ": gives no pair");
      }
      general_.push_back({entries_, &entry, sideOf(a.sources), sideOf(b.sources)});
      return;
    }
    if (first.text == second.text) {
      throw Error(where, "'" + first.text + "' against itself", "name two bodies");
    }
    if (a.is_bare_link || b.is_bare_link) {
      result_.problems.push_back({where, "pair of '" + first.text + "' and '" + second.text +
                                             "' is not served: '" + (a.is_bare_link ? first : second).text +
                                             "' is a link without geometry"});
      return;
    }
    const std::size_t source_a = a.sources.front();
    const std::size_t source_b = b.sources.front();
    if (const char* reason = parts_.filterReason(source_a, source_b)) {
      result_.notes.push_back(where + ": named, so watched in spite of: " + reason);
    }
    namedPair(source_a, source_b).entries.push_back(&entry);
  }

  static void requireNoName(const PairSpec& entry) {
    if (entry.name.empty()) return;
    throw Error(entry.between[0].names.front().where, "the name '" + entry.name + "' for more than one pair",
                "name a pair in an entry that names both its bodies");
  }

  std::vector<std::size_t> sourcesOf(const std::vector<Selector>& selectors) {
    std::vector<std::size_t> sources;
    for (const Selector& selector : selectors) {
      const BodySelector::Selection found = selector_.select(selector);
      sources.insert(sources.end(), found.sources.begin(), found.sources.end());
      if (!found.is_lost) continue;
      result_.problems.push_back({selector.where, "'" + selector.text +
                                                      "' is not known, perhaps it is of a robot that could "
                                                      "not be read; its pairs are not served"});
    }
    return sources;
  }

  void addListEntry(const PairSpec& entry) {
    requireNoName(entry);
    general_.push_back({entries_, &entry, sideOf(sourcesOf(entry.between[0].names)),
                        sideOf(sourcesOf(entry.between[1].names))});
  }

  void addRuleOf(const BodySpec& body) {
    if (!body.added) return;
    AddedBodyRule rule;
    rule.all = body.added->all;
    for (const std::size_t source : sourcesOf(body.added->bodies)) {
      rule.bodies.insert(parts_.sources[source].serial);
    }
    result_.added[body.description.name] = std::make_shared<const AddedBodyRule>(std::move(rule));
  }

  NamedPair* findNamed(std::size_t a, std::size_t b) {
    const auto found = place_.find(std::minmax(a, b));
    return found == place_.end() ? nullptr : &named_[found->second];
  }

  NamedPair& namedPair(std::size_t a, std::size_t b) {
    if (NamedPair* found = findNamed(a, b)) return *found;
    if (named_.size() == pair_limit_) {
      throw Error("pairs", "more than " + std::to_string(pair_limit_) + " named pairs",
                  "use groups and patterns in the scene file's section pairs, or raise largest_pair_count");
    }
    place_[std::minmax(a, b)] = named_.size();
    named_.push_back({a, b, entries_, {}, false});
    return named_.back();
  }

  bool isWatched(std::size_t a, std::size_t b) const {
    return std::any_of(general_.begin(), general_.end(), [&](const Sides& sides) {
      return sides.isWatched() && sides.holdPair(std::min(a, b), std::max(a, b));
    });
  }

  void disable(const std::array<Selector, 2>& selectors) {
    const BodySelector::Selection a = selector_.select(selectors[0]);
    const BodySelector::Selection b = selector_.select(selectors[1]);
    bool any = false;
    if (a.names_one && b.names_one && a.sources.size() == 1 && b.sources.size() == 1) {
      const std::size_t source_a = a.sources.front();
      const std::size_t source_b = b.sources.front();
      any = source_a != source_b &&
            (findNamed(source_a, source_b) != nullptr ||
             (isWatched(source_a, source_b) && parts_.filterReason(source_a, source_b) == nullptr));
      if (any) namedPair(std::min(source_a, source_b), std::max(source_a, source_b)).is_disabled = true;
    } else {
      const Sides sides{0, nullptr, sideOf(a.sources), sideOf(b.sources)};
      for (NamedPair& pair : named_) {
        if (!sides.holdEitherWay(pair.source_a, pair.source_b)) continue;
        any = pair.is_disabled = true;
      }
      for (const std::size_t source_a : a.sources) {
        any = any || std::any_of(b.sources.begin(), b.sources.end(), [&](std::size_t source_b) {
                return source_a != source_b && isWatched(source_a, source_b) &&
                       parts_.filterReason(source_a, source_b) == nullptr;
              });
      }
      disabled_.push_back(sides);
    }
    if (!any) result_.notes.push_back(selectors[0].where + ": disables no watched pair");
  }

  // Holds the rule that the general entries and `disable` give two sources.
  struct Said {
    PairRule rule;
    std::size_t number = 0;  ///< of the first entry
    std::vector<const PairSpec*> entries;
  };

  Said saidOf(std::size_t earlier, std::size_t later) const {
    Said said;
    for (const Sides& sides : general_) {
      if (!sides.holdPair(earlier, later)) continue;
      if (!said.rule.is_watched && sides.isWatched()) {
        const bool earlier_is_a = sides.isOrdered() ? !sides.entry->later_is_a : sides.hold(earlier, later);
        said.rule.is_watched = true;
        said.rule.order = earlier_is_a ? PairOrder::Earlier : PairOrder::Later;
        said.number = sides.number;
      }
      if (sides.entry != nullptr && sides.entry->entry) said.entries.push_back(sides.entry);
    }
    for (const Sides& sides : disabled_) {
      if (sides.holdEitherWay(earlier, later)) said.rule.is_enabled = false;
    }
    return said;
  }

  PairSettings settingsOf(const std::vector<const PairSpec*>& entries, std::size_t a, std::size_t b,
                          std::optional<bool>& enabled) const {
    PairSettings settings = spec_.defaults.pairs;
    std::string where = "pair of '" + parts_.sources[a].name + "' and '" + parts_.sources[b].name + "'";
    for (const PairSpec* entry : entries) {
      if (!entry->entry) continue;
      readPairEntry(*entry->entry, settings, enabled);
      where = entry->entry->where();
    }
    validatePairSettings(settings, where);
    return settings;
  }

  // Sources that all sides hold alike are one class; the first two of each speak for it.
  void makeRules() {
    std::map<Side, std::uint32_t> number{{Side(2 * (general_.size() + disabled_.size()), false), 0}};
    std::vector<std::vector<std::size_t>> members(1);
    for (std::size_t source = 0; source < parts_.sources.size(); ++source) {
      Side held;
      for (const auto* list : {&general_, &disabled_}) {
        for (const Sides& sides : *list) {
          held.push_back(sides.a[source]);
          held.push_back(sides.b[source]);
        }
      }
      const auto [place, is_new] =
          number.emplace(std::move(held), static_cast<std::uint32_t>(members.size()));
      if (is_new) members.emplace_back();
      result_.classes.push_back(place->second);
      if (members[place->second].size() < 2) members[place->second].push_back(source);
    }
    PairRules& rules = result_.rules;
    rules.classes = members.size();
    rules.table.assign(members.size() * members.size(), PairRule());
    rules.settings.assign(1, PairSettings());
    std::map<std::vector<const PairSpec*>, std::pair<std::uint32_t, std::optional<bool>>> made;
    for (std::size_t row = 0; row < members.size(); ++row) {
      for (std::size_t column = 0; column < members.size(); ++column) {
        if (members[row].empty() || members[column].size() < (row == column ? 2U : 1U)) continue;
        const std::size_t earlier = members[row].front();
        const std::size_t later = members[column].back();
        const Said said = saidOf(earlier, later);
        PairRule& rule = rules.of(row, column);
        rule = said.rule;
        if (!rule.is_watched && said.entries.empty()) continue;
        const auto [place, is_new] = made.try_emplace(said.entries);
        auto& [settings, enabled] = place->second;
        if (is_new) {
          PairSettings laid = settingsOf(said.entries, earlier, later, enabled);
          if (!said.entries.empty()) {
            settings = static_cast<std::uint32_t>(rules.settings.size());
            rules.settings.push_back(std::move(laid));
          }
        }
        rule.settings = settings;
        rule.is_enabled = rule.is_enabled && enabled.value_or(true);
      }
    }
  }

  SelectedPair settle(const NamedPair& named) const {
    const bool is_filtered = parts_.filterReason(named.source_a, named.source_b) != nullptr;
    Said said;
    if (!is_filtered) {
      said = saidOf(std::min(named.source_a, named.source_b), std::max(named.source_a, named.source_b));
    }
    SelectedPair pair;
    std::tie(pair.source_a, pair.source_b) = std::pair(named.source_a, named.source_b);
    if (said.rule.is_watched && (said.number < named.number || named.entries.empty())) {
      std::tie(pair.source_a, pair.source_b) = std::minmax(named.source_a, named.source_b);
      if (said.rule.order == PairOrder::Later) std::swap(pair.source_a, pair.source_b);
    }
    said.entries.insert(said.entries.end(), named.entries.begin(), named.entries.end());
    std::optional<bool> enabled;
    pair.settings = settingsOf(said.entries, pair.source_a, pair.source_b, enabled);
    const bool is_disabled =
        named.is_disabled || std::any_of(disabled_.begin(), disabled_.end(), [&](const Sides& s) {
          return s.holdEitherWay(named.source_a, named.source_b);
        });
    pair.enabled = enabled.value_or(true) && !is_disabled;
    for (const PairSpec* entry : named.entries) {
      if (!entry->name.empty()) pair.name = entry->name;
    }
    return pair;
  }

  const SceneSpec& spec_;
  const SceneParts& parts_;
  std::size_t pair_limit_;
  PairSelection result_;
  BodySelector selector_;  // writes its notes into result_
  std::size_t entries_ = 0;
  std::vector<Sides> general_;
  std::vector<Sides> disabled_;
  std::vector<NamedPair> named_;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> place_;  // in named_
};

}  // namespace

std::string bodyLabel(const std::string& body) {
  std::string part = body;
  for (char& c : part) {
    if (!isLetterOrDigit(c)) c = '_';
  }
  return part;
}

PairSelection selectPairs(const SceneSpec& spec, const SceneParts& parts, std::size_t pair_limit) {
  return Selection(spec, parts, pair_limit).run();
}

}  // namespace concave_distance::detail
