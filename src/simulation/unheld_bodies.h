#pragma once

#include <string>
#include <vector>

#include "concave_distance/scene/scene.h"
#include "concave_distance/scene/simulation_settings.h"

namespace concave_distance::detail {

/// A warning for each free body that falls for good: under gravity, without a drive or a load, and without
/// pairs that lead by forces, over other free bodies or not, to a body that is held.
std::vector<std::string> warnOfUnheldBodies(const Scene& scene, const SimulationSettings& settings);

}  // namespace concave_distance::detail
