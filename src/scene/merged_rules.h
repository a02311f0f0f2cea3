#pragma once

#include "concave_distance/scene/scene.h"

namespace concave_distance::detail {

/// Gives a reloaded scene the rules and listed pairs of `fresh`, changed as edits have changed those of
/// `loaded` to become those of `edited`. Bodies with one SceneBody::serial are one body in all of them.
/// @param scene with the bodies that it will have; its rules, pairs and defaults are set
void mergeRules(const Scene& loaded, const Scene& edited, const Scene& fresh, Scene& scene);

}  // namespace concave_distance::detail
