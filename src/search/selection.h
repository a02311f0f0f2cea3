#pragma once

#include <cstdint>
#include <vector>

#include "base/random_engine.h"

namespace concave_distance {

/// Stochastic universal sampling (Baker 1987; Carretero, sec. 2.3.2.a): one spin of a wheel with `count`
/// equally spaced pointers, so that each individual comes floor or ceil of its expectation
/// count * weight / sum. Ascending. O(individuals + count).
/// @param weights of the individuals, not negative, their sum positive and finite
/// @param selected indices of individuals; keeps its capacity
void stochasticUniversalSampling(const std::vector<double>& weights, std::uint32_t count,
                                 RandomEngine& engine, std::vector<std::uint32_t>& selected);

/// Fisher and Yates.
void shuffle(std::vector<std::uint32_t>& values, RandomEngine& engine);

}  // namespace concave_distance
