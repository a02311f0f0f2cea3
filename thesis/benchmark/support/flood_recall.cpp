#include "thesis/benchmark/support/flood_recall.h"

#include <algorithm>

namespace concave_distance::benchmark {
double floodCutoff(const BenchmarkPair& pair, const Eigen::Isometry3d& pose) {
  const double nearest = fclDistance(*pair.fcl_a, *pair.fcl_b, pose).distance;
  return std::max(5.0 * nearest, 0.25 * std::min(pair.a->diameter(), pair.b->diameter()));
}

LocalMinima trueNiches(const BenchmarkPair& pair, const Eigen::Isometry3d& pose, double cutoff,
                       FloodStarts starts, double least_prominence) {
  LocalMinimaRequest request;
  request.cutoff = cutoff;
  request.rule.least_prominence = least_prominence;
  request.rule.prominence_limit = kProminentNiche;
  request.hidden = false;
  request.asked_pairs = std::move(starts);
  return findLocalMinima(*pair.a, *pair.b, pose, request);
}

FloodComparison compareWithFlood(const BenchmarkPair& pair, const Eigen::Isometry3d& pose, double cutoff,
                                 const PairSolution& solution, RecallShares& shares) {
  FloodStarts starts;
  for (const TrackedNiche& niche : solution.niches) {
    if (niche.distance <= cutoff) {
      starts.emplace_back(niche.witness.triangle_a, niche.witness.triangle_b);
    }
  }
  FloodComparison result{trueNiches(pair, pose, cutoff, starts), {}};
  const LocalMinima& truth = result.truth;
  std::vector<std::size_t> hits(truth.niches.size(), 0);
  for (const std::size_t owner : truth.owners) {
    if (owner != LocalMinima::kNoOwner) ++hits[owner];
    shares.none += owner == LocalMinima::kNoOwner ? 1.0 : 0.0;
  }
  for (std::size_t i = 0; i < truth.niches.size(); ++i) {
    const double met = hits[i] > 0 ? 1.0 : 0.0;
    const double prominent = truth.niches[i].prominence >= kProminentNiche ? 1.0 : 0.0;
    shares.truths += 1.0;
    shares.recalled += met;
    shares.prominent_truths += prominent;
    shares.prominent_recalled += prominent * met;
    shares.own += met;
    shares.doubled += hits[i] > 1 ? static_cast<double>(hits[i] - 1) : 0.0;
    if (hits[i] == 0) result.missed.push_back(i);
  }
  shares.reported += static_cast<double>(starts.size());
  return result;
}

}  // namespace concave_distance::benchmark
