#pragma once

#include <vector>

#include "concave_distance/scene/scene.h"
#include "scene_spec.h"

namespace concave_distance::detail {

/// Attaches the bodies of a loaded scene as their file says. One whose parent was not loaded stays where it
/// is, which is a problem of the scene.
/// @throws Error for a parent that is the body itself, a group, or attached to it, and for a body that is in
///         another frame than its parent
void attachBodies(const std::vector<BodySpec>& specs, Scene& scene);

}  // namespace concave_distance::detail
