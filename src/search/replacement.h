#pragma once

#include <cstdint>
#include <vector>

#include "base/random_engine.h"
#include "trial_point_table.h"

namespace concave_distance {

/// Offspring of one generation: the generation gap's share of the population (De Jong 1975), even, at least
/// 2 and at most the population, itself even.
std::uint32_t offspringCount(std::uint32_t population_size, double generation_gap);

/// The seats that `count` offspring take: all of them in order, or a random choice of that many. Seats to be
/// given up are drawn blindly, as in De Jong's overlapping populations; elites are put back afterwards.
/// @param seats indices of individuals; keeps its capacity
void drawSeats(std::uint32_t population_size, std::uint32_t count, RandomEngine& engine,
               std::vector<std::uint32_t>& seats);

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
