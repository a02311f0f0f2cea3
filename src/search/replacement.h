#pragma once

#include <cstdint>
#include <vector>

#include "trial_point_table.h"

namespace concave_distance {

/// The places of the `elite_count` best trial points of a population, best first; fewer when fewer are there.
void findElites(const Census& census, const TrialPointTable& places, std::uint32_t elite_count,
                std::vector<std::uint32_t>& elites);

/// Seats a newcomer where nobody stands yet; with somebody on its place nothing happens. The seat is taken
/// from the most crowded place, so that no niche dies for it; when nobody shares a place, from the worst
/// individual that is no elite. False when there is no such seat. `census` is kept up to date.
bool seatNewcomer(std::uint32_t place, const std::vector<std::uint32_t>& elites,
                  const TrialPointTable& places, Census& census, std::vector<TrialPoint>& population,
                  std::vector<std::uint32_t>& population_places);

/// Puts every elite that nobody of the new population stands on back into it, because sampling of shared
/// fitness can lose the best.
void restoreElites(const std::vector<std::uint32_t>& elites, const TrialPointTable& places, Census& census,
                   std::vector<TrialPoint>& population, std::vector<std::uint32_t>& population_places);

}  // namespace concave_distance
