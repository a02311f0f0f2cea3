#pragma once

#include <cstdint>
#include <vector>

#include "base/random_engine.h"
#include "search/replacement.h"

namespace concave_distance {

/// The thesis's form (Carretero, sec. 4.4.2, 4.6.2): each child for itself against the parent closer to it;
/// the second child meets whoever holds that parent's seat after the first.
void competeWithCloserParent(Contestant& parent_1, Contestant& parent_2, const Contestant& child_1,
                             const Contestant& child_2, TrialPointTable& places, PairMetric& metric);

/// Simple crowding (De Jong 1975; Carretero, sec. 4.4.1): the index of the individual closest to the child
/// among `crowding_factor` drawn from the population with replacement; the child takes its seat whatever its
/// fitness.
std::uint32_t crowdedOut(const std::vector<std::uint32_t>& population_places, std::uint32_t child_place,
                         std::uint32_t crowding_factor, TrialPointTable& places, PairMetric& metric,
                         RandomEngine& engine);

}  // namespace concave_distance
