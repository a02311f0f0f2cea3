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

inline constexpr std::size_t kNoMatch = static_cast<std::size_t>(-1);

/// For every reference the index of a found witness that is that niche, or kNoMatch; looks at the found ones
/// nearest to each reference only, so that lists of hundreds stay cheap.
std::vector<std::size_t> matchReferences(const BenchmarkPair& pair, const Eigen::Isometry3d& pose,
                                         const std::vector<WitnessPair>& found,
                                         const std::vector<ReferenceNiche>& references,
                                         double least_prominence);

/// The same and more: isSameNiche() knows straight ways only. Found witnesses that are left over are led, as
/// the truth was made, from the grid minimum under them over passes of less than `least_prominence` to the
/// bottom of their basin, which may be a reference that is left over. A flood for each of them.
std::vector<std::size_t> matchOverBentPasses(const BenchmarkPair& pair, const Eigen::Isometry3d& pose,
                                             const std::vector<WitnessPair>& found,
                                             const std::vector<ReferenceNiche>& references,
                                             double least_prominence);

/// References that some found witness is, by matchReferences().
std::size_t countRecalled(const BenchmarkPair& pair, const Eigen::Isometry3d& pose,
                          const std::vector<WitnessPair>& found,
                          const std::vector<ReferenceNiche>& references, double least_prominence);

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
