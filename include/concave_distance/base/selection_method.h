#pragma once

#include <cstdint>

namespace concave_distance {

/// Names the ways to draw parents (Carretero, sec. 2.3.2.a).
enum class SelectionMethod : std::uint8_t { StochasticUniversalSampling, Roulette };

}  // namespace concave_distance
