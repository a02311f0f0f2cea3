#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "concave_distance/loading/load_scene.h"
#include "concave_distance/scene/scene.h"
#include "robot_description.h"

namespace concave_distance::detail {

/// All of so many pairs may be solved at any distance; scenes of more need a cutoff.
inline constexpr std::size_t kFewPairs = 1000;

// Checks of a robot's scene from the URDF alone, before anything moves it.

/// Gives the pairs by rule that have no cutoff one, where there are more than kFewPairs: a fifth of the
/// diagonal of the largest body, or of the largest robot in its zero pose; adds a note. Listed pairs keep
/// none.
void limitManyPairs(Scene& scene);

/// Gives every pair a cutoff for the robot's size: a fifth of the diagonal of the box around it in its zero
/// pose, rounded up to two digits; adds a note.
void setAutomaticCutoff(Scene& scene);

/// Adds a warning when no link has geometry of the wanted kind.
void warnOfNoGeometry(Scene& scene, const RobotDescription& robot, GeometrySource geometry);

/// Adds a warning that names the enabled pairs whose bodies overlap in the zero pose and in each of 20 random
/// poses: usually links that overlap by design. options.skip_overlapping_pairs leaves them out. Does nothing
/// when loading was stopped.
/// @return the bodies of each pair that is left out
std::vector<std::pair<std::string, std::string>> reportOverlappingPairs(Scene& scene,
                                                                        const SceneLoadOptions& options);

}  // namespace concave_distance::detail
