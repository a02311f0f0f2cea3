#pragma once

#include <concave_distance/Constraints.h>

#include <string>

#include "concave_distance/kinematics/velocity_guard.h"

namespace concave_distance {

/// Says what decided a scale, and what to do where something is wrong.
/// @param rows that it was decided by @param age of their transforms, s
std::string wordsFor(const GuardDecision& decision, const Constraints& rows, const GuardSettings& settings,
                     double age);

}  // namespace concave_distance
