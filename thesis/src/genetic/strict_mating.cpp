#include "strict_mating.h"

#include <utility>

namespace concave_distance {

void restrictMatingStrictly(std::vector<std::uint32_t>& pool,
                            const std::vector<std::uint32_t>& population_places, double mating_radius,
                            TrialPointTable& places, PairMetric& metric) {
  for (std::size_t first = 0; first + 1 < pool.size(); first += 2) {
    for (std::size_t mate = first + 1; mate < pool.size(); ++mate) {
      if (places.delta(population_places[pool[first]], population_places[pool[mate]], metric) <=
          mating_radius) {
        std::swap(pool[first + 1], pool[mate]);
        break;
      }
    }
  }
}

}  // namespace concave_distance
