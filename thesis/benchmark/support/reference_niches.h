#pragma once

#include <vector>

#include "benchmark/support/benchmark_pairs.h"
#include "concave_distance/tracking/pair_solution.h"

namespace concave_distance::benchmark {

/// A niche of the ground truth.
struct ReferenceNiche {
  WitnessPair witness;  ///< refined
  TrialPoint nodes;     ///< the minimum on the grid
  double node_distance;
  double node_prominence;
};

/// Every outward niche below `cutoff` (metres) whose prominence on the grid is at least `least_prominence`:
/// the flood of the product graph (enumerateNodeNiches), each place refined, one entry a place. It shares no
/// code with the search.
std::vector<ReferenceNiche> referenceNiches(const BenchmarkPair& pair, const Eigen::Isometry3d& pose,
                                            double cutoff, double least_prominence);

/// Whether a refined witness pair is that niche: the same place, or on one plateau or in one basin of less
/// than `least_prominence` with it.
bool isSameNiche(const BenchmarkPair& pair, const Eigen::Isometry3d& pose, const WitnessPair& found,
                 const WitnessPair& reference, double least_prominence);

/// How a list of found niches compares with the truth.
struct RecallCount {
  std::size_t recalled = 0;    ///< references met at least once
  std::size_t duplicates = 0;  ///< found niches beyond the first at one reference
  std::size_t others = 0;      ///< found niches below the cutoff that are no reference
};
RecallCount countRecall(const BenchmarkPair& pair, const Eigen::Isometry3d& pose,
                        const std::vector<WitnessPair>& found, const std::vector<ReferenceNiche>& references,
                        double cutoff, double least_prominence);

}  // namespace concave_distance::benchmark
