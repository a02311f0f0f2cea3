#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "concave_distance/scene/scene.h"

namespace concave_distance::detail {

/// Indices of the pairs whose name is `pattern` or matches it, in the scene's order. See matchesPattern().
/// @throws Error when the pattern is too long or no pair matches
std::vector<std::size_t> matchingPairs(const Scene& scene, const std::string& pattern);

}  // namespace concave_distance::detail
