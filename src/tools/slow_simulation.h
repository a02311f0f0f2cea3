#pragma once

#include <string>

#include "concave_distance/simulation/simulation.h"

namespace concave_distance::tools {

/// Below this share of real time a run says what held it back.
inline constexpr double kSlow = 0.1;

/// Of a run that took `wall_seconds`: which contact or drive held it back, and what to change. Empty at or
/// above kSlow.
std::string whatHeldBack(const Simulation& simulation, double wall_seconds);

}  // namespace concave_distance::tools
