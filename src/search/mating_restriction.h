#pragma once

#include <cstdint>
#include <vector>

#include "base/random_engine.h"
#include "trial_point_table.h"

namespace concave_distance {

/// Pairs up a shuffled mating pool, in place: couple k is entries 2 k and 2 k + 1. The first keeps its seat;
/// its mate is the next in line when both are within `mating_radius` (metres) of each other, else one drawn
/// from those behind, and when that one is too far as well a third, drawn without looking (Carretero, sec.
/// 4.5, 4.6.3, after Deb and Goldberg 1989).
/// @param pool individuals, an even number of them
/// @param population_places the place of each individual
void restrictMating(std::vector<std::uint32_t>& pool, const std::vector<std::uint32_t>& population_places,
                    double mating_radius, TrialPointTable& places, PairMetric& metric, RandomEngine& engine);

}  // namespace concave_distance
