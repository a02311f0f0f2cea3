#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "concave_distance/scene/scene.h"
#include "scene_parts.h"
#include "scene_spec.h"

namespace concave_distance::detail {

/// A pair of sources, whether they will load or not, so that names and order do not depend on that.
struct SelectedPair {
  std::string name;
  std::size_t source_a = 0;
  std::size_t source_b = 0;
  bool enabled = true;
  PairSettings settings;
};

struct PairSelection {
  std::vector<SelectedPair> pairs;     ///< in the order in which the file's entries give them
  std::vector<SceneProblem> problems;  ///< pairs asked for by name that cannot be
  std::vector<std::string> notes;
  std::map<std::string, std::vector<std::string>> groups;  ///< names of their sources
};

/// Applies the file's groups, pairs and disabled pairs, and the filters of the robots.
/// @throws Error for names that are not known, settings that do not go together and more pairs than allowed
PairSelection selectPairs(const SceneSpec& spec, const SceneParts& parts, std::size_t pair_limit);

}  // namespace concave_distance::detail
