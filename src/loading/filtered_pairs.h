#pragma once

#include "concave_distance/scene/scene.h"
#include "scene_parts.h"

namespace concave_distance::detail {

/// Leaves out the pairs that adjacency or an SRDF does. The bodies of the scene are the sources.
void filterPairs(const SceneParts& parts, Scene& scene);

/// Adds a note for each kind of filter with the number of pairs that the rules would give without it.
void noteFilteredPairs(const SceneParts& parts, Scene& scene);

}  // namespace concave_distance::detail
