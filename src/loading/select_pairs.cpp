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
#include "entry_rules.h"
#include "filtered_pairs.h"

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
    const std::string wanted = bodyLabel(source.name);
    std::string label = wanted;
    for (int copy = 2; !taken.insert(label).second; ++copy) label = wanted + "_" + std::to_string(copy);
    labels.push_back(std::move(label));
  }
  return labels;
}

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
      : spec_(spec),
        parts_(parts),
        pair_limit_(pair_limit),
        selector_(parts, spec.groups, result_.notes),
        rules_(spec, parts) {}

  PairSelection run() {
    result_.labels = labelsOf(parts_.sources);
    result_.filtered = filteredPairs(parts_);
    if (spec_.pairs) {
      for (const PairSpec& entry : *spec_.pairs) addEntry(entry);
    } else {
      const SourceFlags all(parts_.sources.size(), true);
      rules_.add({0, nullptr, all, all});
    }
    for (const auto& sides : spec_.disabled) disable(sides);
    rules_.makeRules(result_);
    noteFilteredPairs(parts_, result_);
    for (const NamedPair& pair : named_) result_.pairs.push_back(settle(pair));
    for (const auto& [name, sources] : selector_.groups()) {
      std::vector<std::string>& members = result_.groups[name];
      for (const std::size_t source : sources) members.push_back(parts_.sources[source].name);
    }
    return std::move(result_);
  }

 private:
  SourceFlags sideOf(const std::vector<std::size_t>& sources) const {
    SourceFlags side(parts_.sources.size(), false);
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
      rules_.add({entries_, &entry, sideOf(a.sources), sideOf(b.sources)});
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
    rules_.add({entries_, &entry, sideOf(sourcesOf(entry.between[0].names)),
                sideOf(sourcesOf(entry.between[1].names))});
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

  void disable(const std::array<Selector, 2>& selectors) {
    const BodySelector::Selection a = selector_.select(selectors[0]);
    const BodySelector::Selection b = selector_.select(selectors[1]);
    bool any = false;
    if (a.names_one && b.names_one && a.sources.size() == 1 && b.sources.size() == 1) {
      const std::size_t source_a = a.sources.front();
      const std::size_t source_b = b.sources.front();
      any = source_a != source_b &&
            (findNamed(source_a, source_b) != nullptr ||
             (rules_.isWatched(source_a, source_b) && parts_.filterReason(source_a, source_b) == nullptr));
      if (any) namedPair(std::min(source_a, source_b), std::max(source_a, source_b)).is_disabled = true;
    } else {
      const EntrySides sides{0, nullptr, sideOf(a.sources), sideOf(b.sources)};
      for (NamedPair& pair : named_) {
        if (!sides.holdEitherWay(pair.source_a, pair.source_b)) continue;
        any = pair.is_disabled = true;
      }
      for (const std::size_t source_a : a.sources) {
        any = any || std::any_of(b.sources.begin(), b.sources.end(), [&](std::size_t source_b) {
                return source_a != source_b && rules_.isWatched(source_a, source_b) &&
                       parts_.filterReason(source_a, source_b) == nullptr;
              });
      }
      rules_.disable(sides);
    }
    if (!any) result_.notes.push_back(selectors[0].where + ": disables no watched pair");
  }

  SelectedPair settle(const NamedPair& named) const {
    const bool is_filtered = parts_.filterReason(named.source_a, named.source_b) != nullptr;
    EntryRules::Said said;
    if (!is_filtered) {
      said =
          rules_.saidOf(std::min(named.source_a, named.source_b), std::max(named.source_a, named.source_b));
    }
    SelectedPair pair;
    std::tie(pair.source_a, pair.source_b) = std::pair(named.source_a, named.source_b);
    if (said.rule.is_watched && (said.number < named.number || named.entries.empty())) {
      std::tie(pair.source_a, pair.source_b) = std::minmax(named.source_a, named.source_b);
      if (said.rule.order == PairOrder::Later) std::swap(pair.source_a, pair.source_b);
    }
    said.entries.insert(said.entries.end(), named.entries.begin(), named.entries.end());
    std::optional<bool> enabled;
    pair.settings = rules_.settingsOf(said.entries, pair.source_a, pair.source_b, enabled);
    const bool is_disabled = named.is_disabled || rules_.isDisabled(named.source_a, named.source_b);
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
  EntryRules rules_;
  std::size_t entries_ = 0;
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
