#pragma once

#include <concave_distance/BodyState.h>
#include <concave_distance/GetScene.h>
#include <concave_distance/Reload.h>

#include "concave_distance/scene/scene.h"
#include "scene/frames_now.h"
#include "scene/reload_scene.h"

namespace concave_distance {

/// Fills what get_scene says of bodies, groups and pairs.
/// @param frames what tf knows of the bodies' frames
void fillState(const Scene& scene, const detail::FramesNow& frames, bool with_meshes,
               GetScene::Response& response);

/// Fills what reload says of bodies and edits.
void fillReport(detail::ReloadReport report, Reload::Response& response);

}  // namespace concave_distance
