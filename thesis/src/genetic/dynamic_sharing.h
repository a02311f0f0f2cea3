#pragma once

#include <cstdint>
#include <vector>

#include "search/trial_point_table.h"

namespace concave_distance {

/// Buffers of dynamicNicheCounts(); keep their capacity.
struct DynamicNicheBuffers {
  std::vector<std::uint32_t> order;
  std::vector<std::uint32_t> peaks;
  std::vector<std::uint32_t> peak_of_entry;
};

/// Dynamic niche counts (Miller and Shaw 1996): from the fittest place on, each that is not within the
/// sharing radius of an earlier peak becomes one, until there are `niche_limit`; whoever is within the radius
/// of a peak (of several, the fittest) counts all individuals of that peak's niche, whoever is not shares as
/// above. O(places * peaks) distances while the limit is not reached.
void dynamicNicheCounts(const Census& census, TrialPointTable& places, PairMetric& metric,
                        double sharing_radius, double sharing_exponent, std::uint32_t niche_limit,
                        DynamicNicheBuffers& buffers, std::vector<double>& niche_counts);

}  // namespace concave_distance
