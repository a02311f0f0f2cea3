#include "entry_rules.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "settings_reader.h"

namespace concave_distance::detail {

bool EntryRules::isWatched(std::size_t source_a, std::size_t source_b) const {
  return std::any_of(general_.begin(), general_.end(), [&](const EntrySides& sides) {
    return sides.isWatched() && sides.holdPair(std::min(source_a, source_b), std::max(source_a, source_b));
  });
}

bool EntryRules::isDisabled(std::size_t source_a, std::size_t source_b) const {
  return std::any_of(disabled_.begin(), disabled_.end(),
                     [&](const EntrySides& sides) { return sides.holdEitherWay(source_a, source_b); });
}

EntryRules::Said EntryRules::saidOf(std::size_t earlier, std::size_t later) const {
  Said said;
  for (const EntrySides& sides : general_) {
    if (!sides.holdPair(earlier, later)) continue;
    if (!said.rule.is_watched && sides.isWatched()) {
      const bool earlier_is_a = sides.isOrdered() ? !sides.entry->later_is_a : sides.hold(earlier, later);
      said.rule.is_watched = true;
      said.rule.order = earlier_is_a ? PairOrder::Earlier : PairOrder::Later;
      said.number = sides.number;
    }
    if (sides.entry != nullptr && sides.entry->entry) said.entries.push_back(sides.entry);
  }
  if (isDisabled(earlier, later)) said.rule.is_enabled = false;
  return said;
}

PairSettings EntryRules::settingsOf(const std::vector<const PairSpec*>& entries, std::size_t a, std::size_t b,
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

// The first two sources of a class speak for it.
void EntryRules::makeRules(PairSelection& result) const {
  std::map<SourceFlags, std::uint32_t> number{
      {SourceFlags(2 * (general_.size() + disabled_.size()), false), 0}};
  std::vector<std::vector<std::size_t>> members(1);
  for (std::size_t source = 0; source < parts_.sources.size(); ++source) {
    SourceFlags held;
    for (const auto* list : {&general_, &disabled_}) {
      for (const EntrySides& sides : *list) {
        held.push_back(sides.a[source]);
        held.push_back(sides.b[source]);
      }
    }
    const auto [place, is_new] = number.emplace(std::move(held), static_cast<std::uint32_t>(members.size()));
    if (is_new) members.emplace_back();
    result.classes.push_back(place->second);
    if (members[place->second].size() < 2) members[place->second].push_back(source);
  }
  PairRules& rules = result.rules;
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
        const PairSettings laid = settingsOf(said.entries, earlier, later, enabled);
        if (!said.entries.empty()) {
          settings = static_cast<std::uint32_t>(rules.settings.size());
          rules.settings.push_back(laid);
        }
      }
      rule.settings = settings;
      rule.is_enabled = rule.is_enabled && enabled.value_or(true);
    }
  }
}

}  // namespace concave_distance::detail
