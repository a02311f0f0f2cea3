#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "concave_distance/scene/scene.h"
#include "scene_parts.h"
#include "scene_spec.h"

namespace concave_distance::detail {

/// A pair of sources that is named, whether they will load or not, so that names and order do not depend on
/// that.
struct SelectedPair {
  std::string name;  ///< empty: from the labels of its sources
  std::size_t source_a = 0;
  std::size_t source_b = 0;
  bool enabled = true;
  PairSettings settings;
};

struct PairSelection {
  std::vector<SelectedPair> pairs;     ///< those that entries name by both bodies, in the order of the file
  PairRules rules;                     ///< of all others, without PairRules::filtered
  std::vector<std::uint32_t> classes;  ///< of the sources
  std::vector<std::string> labels;     ///< of the sources, each usable in a topic's name and once only
  std::vector<std::pair<std::size_t, std::size_t>> filtered;  ///< sources whose pair no rule gives
  std::vector<SceneProblem> problems;                         ///< pairs asked for by name that cannot be
  std::vector<std::string> notes;
  std::map<std::string, std::vector<std::string>> groups;  ///< names of their sources
};

/// Returns what names of pairs call a body that nothing else is said of: its name, usable in a topic's name.
std::string bodyLabel(const std::string& body);

/// Applies the file's groups, pairs and disabled pairs, and the filters of the robots.
/// @param pair_limit of named pairs
/// @throws Error for names that are not known, settings that do not go together and more pairs than allowed
PairSelection selectPairs(const SceneSpec& spec, const SceneParts& parts, std::size_t pair_limit);

}  // namespace concave_distance::detail
