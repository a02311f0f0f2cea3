#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "concave_distance/scene/simulation_settings.h"
#include "concave_distance/scene/tracked_pair.h"

namespace concave_distance {

/// Solves poses of B in A's frame one after the other, as the cycles of a pair that begins anew: niches have
/// no history and ids begin at 1. Its time budget, effects and warnings are left out, so that equal bodies,
/// settings and poses give equal answers, to the last bit.
/// @param pair with the settings; its bodies are these two
/// @param poses at times that do not descend, seconds
/// @param end of the work, of which the last answer is not called for
/// @param stop ends it, too; nullptr: nothing does
/// @param visit called with the place of each pose and the pair with its answer; returns whether to go on
/// @return number of poses answered
std::size_t replayPair(const ScenePair& pair, const std::shared_ptr<const SceneBody>& body_a,
                       const std::shared_ptr<const SceneBody>& body_b, const std::vector<TimedPose>& poses,
                       bool with_niches, WorkLimit::Clock::time_point end, const std::atomic<bool>* stop,
                       const std::function<bool(std::size_t, const TrackedPair&)>& visit);

}  // namespace concave_distance
