#pragma once

#include <string>
#include <vector>

#include "concave_distance/scene/scene.h"
#include "scene/scene_operation.h"

namespace concave_distance {

/// Lays effects, written as `effects` of a scene file (doc/scene_file.md), over those of every pair whose
/// name matches.
/// @param pattern a pair's name, or with * for any characters and ? for one; at most 4096 characters
/// @return the pairs' names, in the scene's order
/// @throws Error for a pattern that no pair matches and for a text that is refused: key, value seen and what
///         is allowed. Pairs may have been set by then: work on a copy
std::vector<std::string> setEffects(Scene& scene, const std::string& pattern, const std::string& yaml);

namespace detail {

/// Returns the operation that does this. @param where names the text in errors. @throws Error for no YAML
SceneOperation effectsOperation(const std::string& pattern, const std::string& yaml,
                                const std::string& where);

/// Returns all of these effects as a text, which leaves nothing of those that it is laid over.
std::string effectsText(const EffectSettings& effects);

}  // namespace detail
}  // namespace concave_distance
