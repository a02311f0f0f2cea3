#include "select_pairs.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "base/ascii.h"
#include "body_selector.h"
#include "concave_distance/base/error.h"
#include "settings_reader.h"
#include "wording.h"

namespace concave_distance::detail {
namespace {

using SourcePair = std::pair<std::size_t, std::size_t>;

SourcePair unordered(std::size_t a, std::size_t b) {
  return {std::min(a, b), std::max(a, b)};
}

// Usable in a topic's name: letters, digits and _.
std::string topicPart(const std::string& body) {
  std::string part = body;
  for (char& c : part) {
    if (!isLetterOrDigit(c)) c = '_';
  }
  return part;
}

// The entries that speak of one pair, in the order of the file; those that name both its bodies come last.
struct Candidate {
  std::size_t source_a;
  std::size_t source_b;
  std::vector<const PairSpec*> general;
  std::vector<const PairSpec*> own;
  bool disabled = false;
};

class Selection {
 public:
  Selection(const SceneSpec& spec, const SceneParts& parts, std::size_t pair_limit)
      : spec_(spec), parts_(parts), pair_limit_(pair_limit), selector_(parts, spec.groups, result_.notes) {}

  PairSelection run() {
    if (spec_.pairs) {
      for (const PairSpec& entry : *spec_.pairs) addEntry(entry);
    } else {
      std::vector<std::size_t> all(parts_.sources.size());
      std::iota(all.begin(), all.end(), std::size_t{0});
      addPairs(all, all, nullptr);
    }
    for (const auto& sides : spec_.disabled) disable(sides);
    for (const auto& [reason, pairs] : filtered_) {
      result_.notes.push_back(counted(pairs.size(), "pair") + " left out: " + reason);
    }
    finish();
    for (const auto& [name, sources] : selector_.groups()) {
      std::vector<std::string>& members = result_.groups[name];
      for (const std::size_t source : sources) members.push_back(parts_.sources[source].name);
    }
    return std::move(result_);
  }

 private:
  void addEntry(const PairSpec& entry) {
    const BodySelector::Selection a = selector_.select(entry.between[0]);
    const BodySelector::Selection b = selector_.select(entry.between[1]);
    const std::string& where = entry.between[0].where;
    if (a.is_lost || b.is_lost) {
      result_.problems.push_back(
          {where, "pairs of '" + entry.between[0].text + "' and '" + entry.between[1].text +
                      "' are not served: '" + entry.between[a.is_lost ? 0 : 1].text +
                      "' is not known, perhaps it is of a robot that could not be read"});
      return;
    }
    if (!(a.names_one && b.names_one)) {
      if (!entry.name.empty()) {
        throw Error(where, "the name '" + entry.name + "' for more than one pair",
                    "name a pair in an entry that names both its bodies");
      }
      if (addPairs(a.sources, b.sources, &entry) == 0) {
        result_.notes.push_back(where + ": gives no pair");
      }
      return;
    }
    if (entry.between[0].text == entry.between[1].text) {
      throw Error(where, "'" + entry.between[0].text + "' against itself", "name two bodies");
    }
    if (a.is_bare_link || b.is_bare_link) {
      result_.problems.push_back({where, "pair of '" + entry.between[0].text + "' and '" +
                                             entry.between[1].text + "' is not served: '" +
                                             entry.between[a.is_bare_link ? 0 : 1].text +
                                             "' is a link without geometry"});
      return;
    }
    const std::size_t source_a = a.sources.front();
    const std::size_t source_b = b.sources.front();
    if (const char* reason = parts_.filterReason(source_a, source_b)) {
      result_.notes.push_back(where + ": named, so watched in spite of: " + reason);
    }
    candidateOf(source_a, source_b).own.push_back(&entry);
  }

  // Every pair of the two sides that no filter holds back. Returns how many the sides have
  // before the filters.
  std::size_t addPairs(const std::vector<std::size_t>& side_a, const std::vector<std::size_t>& side_b,
                       const PairSpec* entry) {
    std::set<SourcePair> seen;
    for (const std::size_t a : side_a) {
      for (const std::size_t b : side_b) {
        if (a == b || !seen.insert(unordered(a, b)).second) continue;
        if (const char* reason = parts_.filterReason(a, b)) {
          filtered_[reason].insert(unordered(a, b));
        } else if (Candidate& candidate = candidateOf(a, b); entry != nullptr) {
          candidate.general.push_back(entry);
        }
      }
    }
    return seen.size();
  }

  Candidate& candidateOf(std::size_t a, std::size_t b) {
    const auto [place, is_new] = number_.emplace(unordered(a, b), candidates_.size());
    if (is_new && candidates_.size() == pair_limit_) {
      const std::size_t bodies = parts_.sources.size();
      throw Error(
          "pairs",
          "more than " + std::to_string(pair_limit_) + " pairs of " + std::to_string(bodies) + " bodies",
          "name the pairs to watch in the scene file's section pairs, or raise largest_pair_count");
    }
    if (is_new) candidates_.push_back({a, b, {}, {}});
    return candidates_[place->second];
  }

  void disable(const std::array<Selector, 2>& sides) {
    const BodySelector::Selection a = selector_.select(sides[0]);
    const BodySelector::Selection b = selector_.select(sides[1]);
    bool any = false;
    for (const std::size_t source_a : a.sources) {
      for (const std::size_t source_b : b.sources) {
        const auto found = number_.find(unordered(source_a, source_b));
        if (source_a == source_b || found == number_.end()) continue;
        candidates_[found->second].disabled = true;
        any = true;
      }
    }
    if (!any) result_.notes.push_back(sides[0].where + ": disables no watched pair");
  }

  SelectedPair settle(const Candidate& candidate) const {
    SelectedPair pair;
    pair.source_a = candidate.source_a;
    pair.source_b = candidate.source_b;
    pair.settings = spec_.defaults.pairs;
    std::optional<bool> enabled;
    std::string where = "pair of '" + parts_.sources[candidate.source_a].name + "' and '" +
                        parts_.sources[candidate.source_b].name + "'";
    for (const auto* entries : {&candidate.general, &candidate.own}) {
      for (const PairSpec* entry : *entries) {
        if (entry->entry) {
          readPairEntry(*entry->entry, pair.settings, enabled);
          where = entry->entry->where();
        }
        if (!entry->name.empty()) pair.name = entry->name;
      }
    }
    pair.enabled = enabled.value_or(true) && !candidate.disabled;
    validatePairSettings(pair.settings, where);
    return pair;
  }

  void finish() {
    std::set<std::string> taken;
    if (spec_.pairs) {
      for (const PairSpec& entry : *spec_.pairs) taken.insert(entry.name);
    }
    for (const Candidate& candidate : candidates_) {
      SelectedPair pair = settle(candidate);
      if (pair.name.empty()) {
        const std::string name = topicPart(parts_.sources[pair.source_a].name) + "/" +
                                 topicPart(parts_.sources[pair.source_b].name);
        pair.name = name;
        for (int i = 2; !taken.insert(pair.name).second; ++i) pair.name = name + "_" + std::to_string(i);
      }
      result_.pairs.push_back(std::move(pair));
    }
  }

  const SceneSpec& spec_;
  const SceneParts& parts_;
  std::size_t pair_limit_;
  PairSelection result_;
  BodySelector selector_;  // writes its notes into result_
  std::vector<Candidate> candidates_;
  std::map<SourcePair, std::size_t> number_;
  std::map<std::string, std::set<SourcePair>> filtered_;
};

}  // namespace

PairSelection selectPairs(const SceneSpec& spec, const SceneParts& parts, std::size_t pair_limit) {
  return Selection(spec, parts, pair_limit).run();
}

}  // namespace concave_distance::detail
