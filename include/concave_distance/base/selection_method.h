#pragma once

#include <cstdint>

namespace concave_distance {

/// How parents are drawn (Carretero, sec. 2.3.2.a).
enum class SelectionMethod : std::uint8_t { StochasticUniversalSampling, Roulette };

}  // namespace concave_distance
