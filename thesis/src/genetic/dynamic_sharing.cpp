#include "dynamic_sharing.h"

#include <algorithm>
#include <numeric>

#include "search/sharing.h"

namespace concave_distance {
namespace {

/// Sum of S over everybody, for one place.
double nicheCount(const Census& census, std::size_t entry, TrialPointTable& places, PairMetric& metric,
                  double sharing_radius, double sharing_exponent) {
  double count = 0.0;
  for (std::size_t i = 0; i < census.places.size(); ++i) {
    const double delta = places.delta(census.places[entry], census.places[i], metric);
    count += census.counts[i] * sharingValue(delta, sharing_radius, sharing_exponent);
  }
  return count;
}

}  // namespace

void dynamicNicheCounts(const Census& census, TrialPointTable& places, PairMetric& metric,
                        double sharing_radius, double sharing_exponent, std::uint32_t niche_limit,
                        DynamicNicheBuffers& buffers, std::vector<double>& niche_counts) {
  constexpr std::uint32_t kNoPeak = 0xffffffffU;
  auto& [order, peaks, peak_of_entry] = buffers;
  order.resize(census.places.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t l, std::uint32_t r) {
    return places.point(census.places[l]) < places.point(census.places[r]);
  });
  peaks.clear();
  peak_of_entry.assign(census.places.size(), kNoPeak);
  niche_counts.assign(census.places.size(), 0.0);
  for (const std::uint32_t entry : order) {
    const std::uint32_t place = census.places[entry];
    const auto peak = std::find_if(peaks.begin(), peaks.end(), [&](std::uint32_t candidate) {
      return places.delta(place, census.places[candidate], metric) < sharing_radius;
    });
    if (peak != peaks.end()) {
      peak_of_entry[entry] = *peak;
    } else if (peaks.size() < niche_limit) {
      peaks.push_back(entry);
      peak_of_entry[entry] = entry;
    } else {
      niche_counts[entry] = nicheCount(census, entry, places, metric, sharing_radius, sharing_exponent);
      continue;
    }
    niche_counts[peak_of_entry[entry]] += census.counts[entry];
  }
  for (std::size_t entry = 0; entry < peak_of_entry.size(); ++entry) {
    if (peak_of_entry[entry] != kNoPeak) {
      niche_counts[entry] = niche_counts[peak_of_entry[entry]];
    }
  }
}

}  // namespace concave_distance
