#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "scene_parts.h"
#include "select_pairs.h"

namespace concave_distance::detail {

/// Returns the pairs of sources that adjacency or an SRDF leaves out, the lesser number first.
std::vector<std::pair<std::size_t, std::size_t>> filteredPairs(const SceneParts& parts);

/// Adds a note for each kind of filter with the number of pairs that the rules would give without it.
/// O(sources x classes).
void noteFilteredPairs(const SceneParts& parts, PairSelection& selection);

}  // namespace concave_distance::detail
