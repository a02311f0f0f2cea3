#include "niche_identification.h"

#include <algorithm>
#include <numeric>

namespace concave_distance {

void identifyNiches(const std::vector<TrialPoint>& population, double niche_radius, PairMetric& metric,
                    std::vector<IdentifiedNiche>& niches, std::vector<std::uint32_t>& order) {
  order.resize(population.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t l, std::uint32_t r) { return population[l] < population[r]; });
  niches.clear();
  // "Best, strip, repeat" puts a point into the first niche, in ascending order, whose best is near enough:
  // one pass finds the same. Individuals on one place are neighbours in the order and share the answer.
  IdentifiedNiche* last_niche = nullptr;
  const TrialPoint* last_point = nullptr;
  for (const std::uint32_t individual : order) {
    const TrialPoint& point = population[individual];
    if (last_point == nullptr || !samePlace(*last_point, point)) {
      const auto found = std::find_if(niches.begin(), niches.end(), [&](const IdentifiedNiche& niche) {
        return metric.distance(niche.best, point) <= niche_radius;
      });
      if (found != niches.end()) {
        last_niche = &*found;
      } else {
        niches.push_back({point, 0});
        last_niche = &niches.back();
      }
      last_point = &point;
    }
    ++last_niche->member_count;
  }
}

}  // namespace concave_distance
