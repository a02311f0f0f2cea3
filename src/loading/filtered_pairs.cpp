#include "filtered_pairs.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "kinematics/wording.h"

namespace concave_distance::detail {
namespace {

// Pairs that the rules would give of sources whose frames never move against each other.
std::size_t countRigidPairs(const SceneParts& parts, const PairSelection& selection) {
  std::map<std::string, std::vector<std::size_t>> rigid;  // sources by what stands for their frames
  for (std::size_t i = 0; i < parts.sources.size(); ++i) {
    rigid[parts.rigid.rootOf(parts.sources[i].frame)].push_back(i);
  }
  std::size_t count = 0;
  for (const auto& [root, sources] : rigid) {
    std::vector<std::size_t> of_class(selection.rules.classes, 0);
    for (const std::size_t later : sources) {
      for (std::size_t row = 0; row < of_class.size(); ++row) {
        if (selection.rules.of(row, selection.classes[later]).is_watched) count += of_class[row];
      }
      ++of_class[selection.classes[later]];
    }
  }
  return count;
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> filteredPairs(const SceneParts& parts) {
  std::map<std::string, std::size_t> source_of_name;
  for (std::size_t i = 0; i < parts.sources.size(); ++i) source_of_name[parts.sources[i].name] = i;
  std::set<LinkPair> all = parts.disabled_by_srdf;
  all.insert(parts.adjacent.begin(), parts.adjacent.end());
  std::vector<std::pair<std::size_t, std::size_t>> filtered;
  for (const LinkPair& pair : all) {
    const auto a = source_of_name.find(pair.first);
    const auto b = source_of_name.find(pair.second);
    if (a != source_of_name.end() && b != source_of_name.end() && a->second != b->second) {
      filtered.emplace_back(std::minmax(a->second, b->second));
    }
  }
  return filtered;
}

void noteFilteredPairs(const SceneParts& parts, PairSelection& selection) {
  std::map<std::string, std::size_t> counts;
  std::size_t rigid = countRigidPairs(parts, selection);
  for (const auto& [a, b] : selection.filtered) {
    if (!selection.rules.of(selection.classes[a], selection.classes[b]).is_watched) continue;
    const std::string reason = parts.filterReason(a, b);
    const bool is_rigid = parts.rigid.areJoined(parts.sources[a].frame, parts.sources[b].frame);
    if (is_rigid && reason == SceneParts::kDisabledBySrdf) --rigid;
    if (!is_rigid || reason == SceneParts::kDisabledBySrdf) ++counts[reason];
  }
  if (rigid > 0) counts[SceneParts::kRigid] = rigid;
  for (const auto& [reason, count] : counts) {
    selection.notes.push_back(counted(count, "pair") + " left out: " + reason);
  }
}

}  // namespace concave_distance::detail
