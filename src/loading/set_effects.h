#pragma once

#include <string>
#include <vector>

#include "concave_distance/scene/scene.h"

namespace concave_distance {

/// Lays effects, written as `effects` of a scene file (doc/scene_file.md), over those of every pair whose
/// name matches.
/// @param pattern a pair's name, or with * for any characters and ? for one; at most 4096 characters
/// @return the pairs' names, in the scene's order
/// @throws Error for a pattern that no pair matches and for a text that is refused: key, value seen and what
///         is allowed. Pairs may have been set by then: work on a copy
std::vector<std::string> setEffects(Scene& scene, const std::string& pattern, const std::string& yaml);

}  // namespace concave_distance
