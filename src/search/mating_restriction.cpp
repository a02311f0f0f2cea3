#include "mating_restriction.h"

#include <utility>

namespace concave_distance {

void restrictMating(std::vector<std::uint32_t>& pool, const std::vector<std::uint32_t>& population_places,
                    double mating_radius, TrialPointTable& places, PairMetric& metric, RandomEngine& engine) {
  constexpr int kTries = 2;
  for (std::size_t first = 0; first + 1 < pool.size(); first += 2) {
    const std::size_t mate = first + 1;
    const auto behind = static_cast<std::uint32_t>(pool.size() - mate);  // the next in line included
    for (int attempt = 0; attempt < kTries; ++attempt) {
      if (places.delta(population_places[pool[first]], population_places[pool[mate]], metric) <=
          mating_radius) {
        break;
      }
      std::swap(pool[mate], pool[mate + uniformIndex(engine, behind)]);
    }
  }
}

}  // namespace concave_distance
