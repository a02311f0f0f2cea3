#pragma once

#include <string>

#include "concave_distance/scene/scene.h"

namespace concave_distance::detail {

/// Returns the section `pairs` of a scene file: the listed pairs, then an entry for each two classes of
/// bodies whose rule is not that of bodies that nothing names. Classes with the same rules are written as
/// one.
std::string savedPairs(const Scene& scene);

}  // namespace concave_distance::detail
