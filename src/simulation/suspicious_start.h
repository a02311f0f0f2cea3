#pragma once

#include <string>
#include <vector>

#include "concave_distance/scene/scene.h"
#include "concave_distance/scene/simulation_settings.h"
#include "concave_distance/simulation/simulation.h"
#include "moving_body.h"

namespace concave_distance::detail {

/// A warning for each free body whose mass cannot lie within its surface: a centre of mass farther outside
/// than the surface is wide, moments of inertia that its mass does not have even at the farthest point, or
/// hardly any.
/// @param moving by body of the scene
std::vector<std::string> warnOfMasses(const Scene& scene, const SimulationSettings& settings,
                                      const std::vector<MovingBody>& moving);

/// A warning for free bodies that pass through each other because the scene has no pair of them, not even a
/// disabled one; links of robots apart.
std::vector<std::string> warnOfMissingPairs(const Scene& scene, const SimulationSettings& settings);

/// A warning for each free body that contact would throw higher than its own size, though nothing moves yet.
/// @param normal sum of the contacts' normal forces on each body, N
std::vector<std::string> warnOfDeepStarts(const SimulationSettings& settings,
                                          const std::vector<MovingBody>& moving,
                                          const std::vector<SimulatedBody>& bodies,
                                          const std::vector<SimulatedPair>& pairs,
                                          const std::vector<Eigen::Vector3d>& normal);

/// A warning for each free body that falls for good: under gravity, without a drive or a load, and without
/// pairs that lead by forces, over other free bodies or not, to a body that is held.
std::vector<std::string> warnOfUnheldBodies(const Scene& scene, const SimulationSettings& settings);

}  // namespace concave_distance::detail
