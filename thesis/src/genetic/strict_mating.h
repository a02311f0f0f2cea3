#pragma once

#include <cstdint>
#include <vector>

#include "search/trial_point_table.h"

namespace concave_distance {

/// As restrictMating(), but the mate is the first of all behind that is within the radius (the pool has been
/// shuffled). Where there is none, the couple stays as it is, farther apart than the radius, and is not to
/// mate.
void restrictMatingStrictly(std::vector<std::uint32_t>& pool,
                            const std::vector<std::uint32_t>& population_places, double mating_radius,
                            TrialPointTable& places, PairMetric& metric);

}  // namespace concave_distance
