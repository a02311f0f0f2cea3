#pragma once

#include <cstdint>
#include <vector>

#include "base/random_engine.h"

namespace concave_distance {

/// Offspring of one generation: the generation gap's share of the population (De Jong 1975), even, at least
/// 2 and at most the population, itself even.
std::uint32_t offspringCount(std::uint32_t population_size, double generation_gap);

/// The seats that `count` offspring take: all of them in order, or a random choice of that many. Seats to be
/// given up are drawn blindly, as in De Jong's overlapping populations; elites are put back afterwards.
/// @param seats indices of individuals; keeps its capacity
void drawSeats(std::uint32_t population_size, std::uint32_t count, RandomEngine& engine,
               std::vector<std::uint32_t>& seats);

}  // namespace concave_distance
