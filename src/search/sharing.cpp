#include "sharing.h"

#include <algorithm>
#include <cmath>

#include "search/grid/body_grid.h"

namespace concave_distance {
namespace {

// The fitness of a pair at distance 0 when nothing bounds it: sums over any population stay finite.
constexpr double kTouchingFitness = 1e200;

}  // namespace

double potentialFitness(double squared_distance, double epsilon) {
  const double denominator = squared_distance + epsilon * epsilon;
  return denominator > 1.0 / kTouchingFitness ? 1.0 / denominator : kTouchingFitness;
}

double fitnessEpsilon(const BodyMesh& a, const BodyMesh& b) {
  return std::max(gridOf(a).nodes().max_edge_length, gridOf(b).nodes().max_edge_length);
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

}  // namespace concave_distance
