#include "sharing.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "search/grid/body_grid.h"

namespace concave_distance {
namespace {

// The fitness of a pair at distance 0 when nothing bounds it: sums over any population stay finite.
constexpr double kTouchingFitness = 1e200;

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

double potentialFitness(double squared_distance, double epsilon) {
  const double denominator = squared_distance + epsilon * epsilon;
  return denominator > 1.0 / kTouchingFitness ? 1.0 / denominator : kTouchingFitness;
}

double fitnessEpsilon(const GeneticParameters& parameters, const BodyMesh& a, const BodyMesh& b) {
  return parameters.fitness_epsilon *
         std::max(gridOf(a).nodes().max_edge_length, gridOf(b).nodes().max_edge_length);
}

double sharingValue(double delta, double radius, double exponent) {
  if (!(delta < radius)) {
    return delta == 0.0 ? 1.0 : 0.0;  // with radius 0 a place still shares with itself
  }
  const double share = delta / radius;
  return 1.0 - (exponent == 1.0 || share == 0.0 ? share : std::pow(share, exponent));
}

void nicheCounts(const Census& census, TrialPointTable& places, PairMetric& metric, double sharing_radius,
                 double sharing_exponent, std::vector<double>& niche_counts) {
  niche_counts.clear();
  for (const std::uint32_t count : census.counts) {
    niche_counts.push_back(count);
  }
  for (std::size_t i = 0; i < census.places.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double delta = places.delta(census.places[i], census.places[j], metric);
      if (delta < sharing_radius) {
        const double shared = sharingValue(delta, sharing_radius, sharing_exponent);
        niche_counts[i] += census.counts[j] * shared;
        niche_counts[j] += census.counts[i] * shared;
      }
    }
  }
}

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
