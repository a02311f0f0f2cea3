#include "select_pairs.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "base/ascii.h"
#include "base/free_name.h"
#include "body_selector.h"
#include "concave_distance/base/error.h"
#include "filtered_pairs.h"
#include "scene/rule_edits.h"
#include "settings_reader.h"

namespace concave_distance::detail {
namespace {

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
    labels.push_back(freeName(bodyLabel(source.name),
                              [&](const std::string& label) { return !taken.insert(label).second; }));
  }
  return labels;
}

/// An entry that is about more than one pair.
struct GeneralEntry {
  const PairSpec* spec;
  BodySet a;
  BodySet b;

  bool holds(std::size_t earlier, std::size_t later) const {
    return (a.contains(earlier) && b.contains(later)) ||
           (!spec->is_ordered && a.contains(later) && b.contains(earlier));
  }
};

/// The entries that name both bodies of one pair.
struct NamedPair {
  std::size_t source_a = 0;
  std::size_t source_b = 0;
  std::vector<const PairSpec*> entries;
};

class Outline {
 public:
  Outline(const SceneSpec& spec, const SceneParts& parts, std::size_t pair_limit)
      : spec_(spec), parts_(parts), pair_limit_(pair_limit), selector_(parts, spec.groups, scene_.notes) {}

  Scene run() {
    scene_.rigid = parts_.rigid;
    scene_.defaults = spec_.defaults;
    const std::vector<std::string> labels = labelsOf(parts_.sources);
    for (std::size_t i = 0; i < labels.size(); ++i) {
      SceneBody body = parts_.sources[i];
      body.label = labels[i] == body.name ? "" : labels[i];
      scene_.bodies.push_back(std::move(body));
    }
    const BodySet all = BodySet::before(scene_.bodies.size());
    if (spec_.pairs) {
      for (const PairSpec& entry : *spec_.pairs) addEntry(entry);
    } else {
      changeRules(scene_, all, all,
                  [](PairRule& rule, PairSettings&, PairOrder order) { rule.watch(order); });
    }
    validateRules();
    listNamedPairs();
    const std::vector<SourcePair> filtered = filterPairs(parts_, scene_);
    for (const auto& sides : spec_.disabled) disable(sides);
    noteFilteredPairs(parts_, filtered, scene_);
    for (const auto& [name, sources] : selector_.groups()) {
      std::vector<std::string>& members = scene_.groups[name];
      for (const std::size_t source : sources) members.push_back(parts_.sources[source].name);
    }
    return std::move(scene_);
  }

 private:
  void addEntry(const PairSpec& entry) {
    if (entry.between[0].is_list || entry.between[1].is_list) {
      requireNoName(entry);
      addGeneral(entry, sourcesOf(entry.between[0].names), sourcesOf(entry.between[1].names));
      return;
    }
    const Selector& first = entry.between[0].names.front();
    const Selector& second = entry.between[1].names.front();
    const BodySelector::Selection a = selector_.select(first);
    const BodySelector::Selection b = selector_.select(second);
    const std::string& where = first.where;
    if (a.is_lost || b.is_lost) {
      scene_.problems.push_back(
          {where, "pairs of '" + first.text + "' and '" + second.text + "' are not served: '" +
                      (a.is_lost ? first : second).text +
                      "' is not known, perhaps it is of a robot that could not be read"});
      return;
    }
    if (!(a.names_one && b.names_one) || entry.is_ordered) {
      requireNoName(entry);
      const bool is_one_body = a.sources.size() == 1 && a.sources == b.sources;
      if (a.sources.empty() || b.sources.empty() || is_one_body) {
        scene_.notes.push_back(where + ": gives no pair");
      }
      addGeneral(entry, a.sources, b.sources);
      return;
    }
    if (first.text == second.text) {
      throw Error(where, "'" + first.text + "' against itself", "name two bodies");
    }
    if (a.is_bare_link || b.is_bare_link) {
      scene_.problems.push_back({where, "pair of '" + first.text + "' and '" + second.text +
                                            "' is not served: '" + (a.is_bare_link ? first : second).text +
                                            "' is a link without geometry"});
      return;
    }
    const std::size_t source_a = a.sources.front();
    const std::size_t source_b = b.sources.front();
    if (const char* reason = parts_.filterReason(source_a, source_b)) {
      scene_.notes.push_back(where + ": named, so watched in spite of: " + reason);
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
      scene_.problems.push_back({selector.where, "'" + selector.text +
                                                     "' is not known, perhaps it is of a robot that could "
                                                     "not be read; its pairs are not served"});
    }
    return sources;
  }

  void addGeneral(const PairSpec& entry, const std::vector<std::size_t>& a,
                  const std::vector<std::size_t>& b) {
    general_.push_back({&entry, BodySet(a), BodySet(b)});
    const RuleChange change = [&](PairRule& rule, PairSettings& settings, PairOrder order) {
      if (entry.is_watched) rule.watch(order);
      std::optional<bool> enabled;
      if (entry.entry) readPairEntry(*entry.entry, settings, enabled);
      rule.is_enabled = enabled.value_or(rule.is_enabled);
    };
    const GeneralEntry& sides = general_.back();
    if (entry.is_ordered) {
      const PairOrder order = entry.later_is_a ? PairOrder::Later : PairOrder::Earlier;
      changeOrderedRules(scene_, sides.a, sides.b, order, change);
    } else {
      changeRules(scene_, sides.a, sides.b, change);
    }
  }

  // A later entry may change what an earlier one says of some pairs, so rules are checked when all are made.
  void validateRules() const {
    for (const PairRule& rule : scene_.rules.list) {
      const std::size_t earlier = rule.earlier.first();
      const std::size_t later = rule.later.last();
      std::string where = namesOf(earlier, later);
      for (const GeneralEntry& entry : general_) {
        if (entry.holds(earlier, later) && entry.spec->entry) where = entry.spec->entry->where();
      }
      validatePairSettings(settingsOf(scene_, rule), where);
    }
  }

  std::string namesOf(std::size_t a, std::size_t b) const {
    return "pair of '" + parts_.sources[a].name + "' and '" + parts_.sources[b].name + "'";
  }

  // Body A is the first that its first entry names, or what entries above this one say.
  NamedPair& namedPair(std::size_t a, std::size_t b) {
    const auto [place, is_new] = place_.emplace(std::minmax(a, b), named_.size());
    if (!is_new) return named_[place->second];
    requireRoom(named_.size());
    const PairRule& rule = scene_.rules.of(std::min(a, b), std::max(a, b));
    if (rule.is_watched && parts_.filterReason(a, b) == nullptr) std::tie(a, b) = rule.ordered(a, b);
    named_.push_back({a, b, {}});
    return named_.back();
  }

  void requireRoom(std::size_t pairs) const {
    if (pairs < pair_limit_) return;
    throw Error("pairs", "more than " + std::to_string(pair_limit_) + " named pairs",
                "use groups and patterns in the scene file's section pairs, or raise largest_pair_count");
  }

  void listNamedPairs() {
    std::set<std::string> taken;
    for (const NamedPair& named : named_) {
      for (const PairSpec* entry : named.entries) taken.insert(entry->name);
    }
    for (const NamedPair& named : named_) {
      ScenePair pair;
      pair.body_a = named.source_a;
      pair.body_b = named.source_b;
      pair.settings = spec_.defaults.pairs;
      if (parts_.filterReason(named.source_a, named.source_b) == nullptr) {
        const auto [earlier, later] = std::minmax(named.source_a, named.source_b);
        const PairRule& rule = scene_.rules.of(earlier, later);
        pair.settings = settingsOf(scene_, rule);
        pair.enabled = rule.is_enabled;
      }
      std::string where = namesOf(named.source_a, named.source_b);
      for (const PairSpec* entry : named.entries) {
        if (!entry->name.empty()) pair.name = entry->name;
        if (!entry->entry) continue;
        std::optional<bool> enabled;
        readPairEntry(*entry->entry, pair.settings, enabled);
        pair.enabled = enabled.value_or(pair.enabled);
        where = entry->entry->where();
      }
      validatePairSettings(pair.settings, where);
      if (pair.name.empty()) {
        pair.name =
            freeName(scene_.bodies[pair.body_a].pairLabel() + "/" + scene_.bodies[pair.body_b].pairLabel(),
                     [&](const std::string& name) { return !taken.insert(name).second; });
      }
      scene_.pairs.push_back(std::move(pair));
    }
  }

  void disable(const std::array<Selector, 2>& selectors) {
    const BodySelector::Selection a = selector_.select(selectors[0]);
    const BodySelector::Selection b = selector_.select(selectors[1]);
    bool any = false;
    if (a.names_one && b.names_one && a.sources.size() == 1 && b.sources.size() == 1) {
      any = disableOne(a.sources.front(), b.sources.front());
    } else {
      const BodySet side_a(a.sources);
      const BodySet side_b(b.sources);
      for (std::size_t i = 0; i < scene_.pairs.size(); ++i) {
        const ScenePair& pair = scene_.pairs[i];
        if ((side_a.contains(pair.body_a) && side_b.contains(pair.body_b)) ||
            (side_a.contains(pair.body_b) && side_b.contains(pair.body_a))) {
          scene_.pairs.edit(i).enabled = false;
          any = true;
        }
      }
      for (std::size_t i = 0; !any && i < a.sources.size(); ++i) {
        any = std::any_of(b.sources.begin(), b.sources.end(), [&](std::size_t source_b) {
          return ruleOf(scene_, a.sources[i], source_b) != nullptr;
        });
      }
      changeRules(scene_, side_a, side_b,
                  [](PairRule& rule, PairSettings&, PairOrder) { rule.is_enabled = false; });
    }
    if (!any) scene_.notes.push_back(selectors[0].where + ": disables no watched pair");
  }

  bool disableOne(std::size_t a, std::size_t b) {
    std::optional<ScenePair> pair = pairOf(scene_, a, b);
    if (!pair) return false;
    const auto listed = scene_.pairs.find(a, b);
    if (!listed) {
      requireRoom(scene_.pairs.size());
      pair->is_from_rule = false;
      scene_.pairs.push_back(std::move(*pair));
    }
    scene_.pairs.edit(listed.value_or(scene_.pairs.size() - 1)).enabled = false;
    return true;
  }

  const SceneSpec& spec_;
  const SceneParts& parts_;
  std::size_t pair_limit_;
  Scene scene_;
  BodySelector selector_;  // writes its notes into scene_
  std::vector<GeneralEntry> general_;
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

Scene outlineOf(const SceneSpec& spec, const SceneParts& parts, std::size_t pair_limit) {
  return Outline(spec, parts, pair_limit).run();
}

}  // namespace concave_distance::detail
