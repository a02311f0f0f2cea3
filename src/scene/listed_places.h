#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "concave_distance/scene/scene_tracker.h"

namespace concave_distance {

/// Returns whether an edit has left a pair as it is: it shares the bodies that it leaves.
bool isUntouched(const TrackedPair& tracked, const Scene& scene, std::size_t index);

/// SceneTracker::placesNow(). @param listed the first of `pairs`, which the scene before has listed
std::vector<std::optional<std::size_t>> placesInTracker(const SceneTracker::Pairs& pairs, std::size_t listed,
                                                        const Scene& scene);

}  // namespace concave_distance
