#pragma once

#include <cstddef>
#include <cstdint>

#include "niche_questions.h"
#include "thesis/src/genetic/niche_identification.h"
#include "trial.h"

namespace concave_distance::evaluation {

/// Distances are sums of squares rounded alike; two node pairs are as good when only rounding parts them.
inline constexpr double kSame = 1.0 + 1e-12;
inline constexpr std::uint64_t kFlopsOfAPair = 26;

/// The radii of niching that the method has on these bodies.
NicheRadii radiiOf(const SceneTruth& scene, const SearchMethod& method);

/// Original triangles of what a search has found.
FoundPlaces placesOf(const SceneTruth& scene, const std::vector<IdentifiedNiche>& reported,
                     const std::vector<TrialPoint>& met);

/// One run over all instants of a scene, in their order: a tracker follows its niches; the population of a
/// GA inherits from the niches of the last one's (Carretero, sec. 6.2.2); every other method starts anew.
/// @param method none of the continuous approach
/// @param questions asked what niches were found, under the number `run`; null: none
TrialRecord runAlong(const Method& method, const MotionOptions& motion, const SceneTruth& scene,
                     std::uint64_t seed, SearchWorkspace& workspace, NicheQuestions* questions,
                     std::size_t run);

}  // namespace concave_distance::evaluation
