#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "concave_distance/scene/scene.h"
#include "scene_parts.h"

namespace concave_distance::detail {

using SourcePair = std::pair<std::size_t, std::size_t>;  // the lesser number first

/// Leaves out the pairs that adjacency or an SRDF does, and returns them. The bodies of the scene are the
/// sources.
std::vector<SourcePair> filterPairs(const SceneParts& parts, Scene& scene);

/// Adds a note for each kind of filter with the number of pairs that the rules would give without it.
/// @param filtered of filterPairs()
void noteFilteredPairs(const SceneParts& parts, const std::vector<SourcePair>& filtered, Scene& scene);

}  // namespace concave_distance::detail
