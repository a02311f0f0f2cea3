#include "generation_gap.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace concave_distance {

std::uint32_t offspringCount(std::uint32_t population_size, double generation_gap) {
  const auto couples = static_cast<std::uint32_t>(std::lround(0.5 * generation_gap * population_size));
  return std::clamp(2 * couples, 2U, population_size);
}

void drawSeats(std::uint32_t population_size, std::uint32_t count, RandomEngine& engine,
               std::vector<std::uint32_t>& seats) {
  seats.resize(population_size);
  std::iota(seats.begin(), seats.end(), 0U);
  if (count == population_size) {
    return;
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    std::swap(seats[i], seats[i + uniformIndex(engine, population_size - i)]);
  }
  seats.resize(count);
}

}  // namespace concave_distance
