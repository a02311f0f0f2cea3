#pragma once

#include <string>

#include "concave_distance/simulation/simulation.h"

namespace concave_distance::tools {

/// A run below this share of real time says what held it back.
inline constexpr double kSlow = 0.1;

/// Returns which contact or drive held a run of `wall_seconds` back, and what to change. Empty at
/// or above kSlow.
std::string whatHeldBack(const Simulation& simulation, double wall_seconds);

}  // namespace concave_distance::tools
