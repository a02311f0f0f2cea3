#include "filtered_pairs.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "kinematics/wording.h"

namespace concave_distance::detail {
namespace {

std::vector<SourcePair> filteredPairs(const SceneParts& parts) {
  std::map<std::string, std::size_t> source_of_name;
  for (std::size_t i = 0; i < parts.sources.size(); ++i) source_of_name[parts.sources[i].name] = i;
  std::set<LinkPair> all = parts.disabled_by_srdf;
  all.insert(parts.adjacent.begin(), parts.adjacent.end());
  std::vector<SourcePair> filtered;
  for (const LinkPair& pair : all) {
    const auto a = source_of_name.find(pair.first);
    const auto b = source_of_name.find(pair.second);
    if (a != source_of_name.end() && b != source_of_name.end() && a->second != b->second) {
      filtered.emplace_back(std::minmax(a->second, b->second));
    }
  }
  return filtered;
}

// Counts the pairs that the rules would give of sources whose frames never move against each other.
std::size_t countRigidPairs(const SceneParts& parts, const PairRules& rules) {
  std::map<std::string, BodySet> rigid;  // by what stands for their frames
  for (std::size_t i = 0; i < parts.sources.size(); ++i)
    rigid[parts.rigid.rootOf(parts.sources[i].frame)].insert(i);
  std::size_t count = 0;
  for (const auto& [root, sources] : rigid) {
    if (sources.size() < 2) continue;
    for (const std::size_t source : sources.indices())
      count += (rules.watchedBefore(source, false) & sources).size();
  }
  return count;
}

}  // namespace

std::vector<SourcePair> filterPairs(const SceneParts& parts, Scene& scene) {
  std::vector<SourcePair> pairs = filteredPairs(parts);
  std::vector<std::pair<std::uint64_t, std::uint64_t>> filtered;
  for (const auto& [a, b] : pairs) {
    filtered.emplace_back(std::minmax(parts.sources[a].serial, parts.sources[b].serial));
  }
  std::sort(filtered.begin(), filtered.end());
  scene.rules.filtered = std::make_shared<const decltype(filtered)>(std::move(filtered));
  return pairs;
}

void noteFilteredPairs(const SceneParts& parts, const std::vector<SourcePair>& filtered, Scene& scene) {
  std::map<std::string, std::size_t> counts;
  std::size_t rigid = countRigidPairs(parts, scene.rules);
  for (const auto& [a, b] : filtered) {
    if (!scene.rules.of(a, b).is_watched) continue;
    const std::string reason = parts.filterReason(a, b);
    const bool is_rigid = parts.rigid.areJoined(parts.sources[a].frame, parts.sources[b].frame);
    if (is_rigid && reason == SceneParts::kDisabledBySrdf) --rigid;
    if (!is_rigid || reason == SceneParts::kDisabledBySrdf) ++counts[reason];
  }
  if (rigid > 0) counts[SceneParts::kRigid] = rigid;
  for (const auto& [reason, count] : counts) {
    scene.notes.push_back(counted(count, "pair") + " left out: " + reason);
  }
}

}  // namespace concave_distance::detail
