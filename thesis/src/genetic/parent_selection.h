#pragma once

#include <cstdint>
#include <vector>

#include "base/random_engine.h"

namespace concave_distance {

/// Names the ways to draw parents (Carretero, sec. 2.3.2.a).
enum class SelectionMethod : std::uint8_t { StochasticUniversalSampling, Roulette };

/// Draws `count` individuals with the method given, stochasticUniversalSampling() or rouletteWheel().
/// @param weights of the individuals, not negative, their sum positive and finite
/// @param wheel buffer
/// @param selected indices of individuals; keeps its capacity
void select(SelectionMethod method, const std::vector<double>& weights, std::uint32_t count,
            RandomEngine& engine, std::vector<double>& wheel, std::vector<std::uint32_t>& selected);

/// Roulette wheel: `count` independent spins. O(individuals + count log individuals).
/// @param wheel buffer of cumulative weights
void rouletteWheel(const std::vector<double>& weights, std::uint32_t count, RandomEngine& engine,
                   std::vector<double>& wheel, std::vector<std::uint32_t>& selected);

}  // namespace concave_distance
