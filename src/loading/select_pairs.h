#pragma once

#include <cstddef>
#include <string>

#include "concave_distance/scene/scene.h"
#include "scene_parts.h"
#include "scene_spec.h"

namespace concave_distance::detail {

/// Returns what names of pairs call a body that nothing else is said of: its name, usable in a topic's name.
std::string bodyLabel(const std::string& body);

/// Returns a scene with every source as a body without a mesh, whether it will load or not, so that names and
/// order do not depend on that: labels, rules, named pairs, groups, problems and notes, as the file's groups,
/// pairs and disabled pairs and the filters of the robots give them.
/// @param pair_limit of named pairs
/// @throws Error for names that are not known, settings that do not go together and more pairs than allowed
Scene outlineOf(const SceneSpec& spec, const SceneParts& parts, std::size_t pair_limit);

}  // namespace concave_distance::detail
