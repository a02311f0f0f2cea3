#pragma once

#include "concave_distance/scene/load_scene.h"
#include "concave_distance/scene/scene.h"
#include "robot_description.h"

namespace concave_distance::detail {

// What can be said of a robot's scene from the URDF alone, before anything moves it.

/// Gives every pair a cutoff that suits a robot of that size: a fifth of the diagonal of the box around it in
/// its zero pose, rounded up to two digits; a note says so.
void setAutomaticCutoff(Scene& scene, const RobotDescription& robot);

/// A warning when no link has geometry of the wanted kind.
void warnOfNoGeometry(Scene& scene, const RobotDescription& robot, GeometrySource geometry);

/// A warning that names the enabled pairs whose bodies overlap in the zero pose and in every one of 20 random
/// poses: links built into one another, as a rule. With options.skip_overlapping_pairs they are left out.
/// Nothing when loading was stopped.
void reportOverlappingPairs(Scene& scene, const RobotDescription& robot, const SceneLoadOptions& options);

}  // namespace concave_distance::detail
