#include "mating.h"

#include <cmath>

#include "concave_distance/base/not_computed.h"
#include "search/grid/mesh_metric.h"

namespace concave_distance {
namespace {

Genes mateOnMesh(NodeIndex fitter, NodeIndex other, const Shares& shares, const MeshMetric& metric) {
  const double length = metric.distance(fitter, other);
  if (fitter == other || !std::isfinite(length)) return {fitter, other};
  return {metric.nodeTowards(fitter, other, shares.first * length),
          metric.nodeTowards(other, fitter, (1.0 - shares.second) * length)};
}

}  // namespace

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

Couple::Couple(const TrialPoint& parent_1, const TrialPoint& parent_2)
    : fitter(parent_2 < parent_1 ? parent_2 : parent_1),
      other(parent_2 < parent_1 ? parent_1 : parent_2),
      share(fitterShare(fitter.squared_distance, other.squared_distance)) {}

Shares Couple::drawShares(RandomEngine& engine) const {
  const double first = share * uniformUnit(engine);
  return {first, share + (1.0 - share) * uniformUnit(engine)};
}

double fitterShare(double fitter_squared_distance, double other_squared_distance) {
  const double sum = fitter_squared_distance + other_squared_distance;
  return sum > 0.0 ? fitter_squared_distance / sum : 0.5;
}

Children childrenOf(const Genes& a, const Genes& b) {
  return {{a.first, b.first, kNotComputed}, {a.second, b.second, kNotComputed}};
}

Children mate(const TrialPoint& parent_1, const TrialPoint& parent_2, PairMetric& metric,
              RandomEngine& engine) {
  const Couple couple(parent_1, parent_2);
  const Genes a =
      mateOnMesh(couple.fitter.node_a, couple.other.node_a, couple.drawShares(engine), metric.onA());
  const Genes b =
      mateOnMesh(couple.fitter.node_b, couple.other.node_b, couple.drawShares(engine), metric.onB());
  return childrenOf(a, b);
}

Children exchangeGenes(const TrialPoint& parent_1, const TrialPoint& donor_1, const TrialPoint& parent_2,
                       const TrialPoint& donor_2) {
  return {{parent_1.node_a, donor_1.node_b, kNotComputed}, {donor_2.node_a, parent_2.node_b, kNotComputed}};
}

}  // namespace concave_distance
