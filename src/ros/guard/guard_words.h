#pragma once

#include <concave_distance/Constraints.h>

#include <string>

#include "concave_distance/kinematics/velocity_guard.h"

namespace concave_distance {

/// The name of the pair, or of the body, that a decision names; empty: none.
std::string pairOf(const GuardDecision& decision, const Constraints& message);
/// Says what decided a scale, and what to do where it is a fault.
/// @param message that it was decided by; nullptr: none has come
/// @param fault said of the command; empty: none
std::string wordsFor(const GuardDecision& decision, const Constraints* message, const GuardSettings& settings,
                     double age, const std::string& fault);

}  // namespace concave_distance
