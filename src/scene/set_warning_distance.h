#pragma once

#include <optional>
#include <string>
#include <vector>

#include "concave_distance/scene/scene.h"

namespace concave_distance {

/// @throws Error for a warning distance beyond the cutoff. @param where of the settings, for the error
void requireWarningWithinCutoff(const PairSettings& settings, const std::string& where);

/// Sets or removes the warning distance of every pair whose name matches.
/// @param pattern a pair's name, or with * for any characters and ? for one; at most 4096 characters
/// @param distance metres; empty: no alert
/// @param hysteresis metres; ignored without a distance
/// @return the pairs' names, in the scene's order
/// @throws Error for a pattern that no pair matches, for lengths that are negative or not finite and for a
///         distance beyond the cutoff of one of the pairs; then nothing is changed if the caller drops the
///         scene
std::vector<std::string> setWarningDistance(Scene& scene, const std::string& pattern,
                                            std::optional<double> distance, double hysteresis);

}  // namespace concave_distance
