#pragma once

#include <cstdint>
#include <vector>

#include "concave_distance/search/trial_point.h"
#include "search/pair_metric.h"

namespace concave_distance {

struct IdentifiedNiche {
  TrialPoint best;
  std::uint32_t member_count;
};

/// Greedy niche identification (Carretero, sec. 4.6.4): the best point, all within sigma_n of it stripped,
/// repeat. Ascending by distance; `niches` and `order` keep their capacity.
void identifyNiches(const std::vector<TrialPoint>& population, double niche_radius, PairMetric& metric,
                    std::vector<IdentifiedNiche>& niches, std::vector<std::uint32_t>& order);

}  // namespace concave_distance
