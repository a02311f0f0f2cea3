#pragma once

#include <utility>
#include <vector>

#include "benchmark/support/benchmark_pairs.h"
#include "concave_distance/tracking/pair_solution.h"
#include "distance/niches/local_minima.h"

namespace concave_distance::benchmark {

/// Prominence from which a niche is a true one, and from which it is a prominent one.
inline constexpr double kLeastTrueProminence = 1e-2;
inline constexpr double kProminentNiche = 5e-2;

/// Reported niches against the true ones, summed over comparisons.
struct RecallShares {
  double truths = 0.0;
  double recalled = 0.0;
  double prominent_truths = 0.0;
  double prominent_recalled = 0.0;
  double reported = 0.0;
  double own = 0.0;      ///< true niches that at least one reported place lies in
  double doubled = 0.0;  ///< reported places that are not the first one in their true niche
  double none = 0.0;     ///< reported places in no true niche

  /// A part of a whole; 1 where there is nothing to have a part of.
  static double share(double part, double whole) { return whole > 0.0 ? part / whole : 1.0; }
  double recall() const { return share(recalled, truths); }
  double prominentRecall() const { return share(prominent_recalled, prominent_truths); }
};

/// The cutoff that true niches are looked for under: 5 times the distance (FCL's) or a quarter of the smaller
/// body's diameter, whichever is larger. Metres.
double floodCutoff(const BenchmarkPair& pair, const Eigen::Isometry3d& pose);

/// Pairs of triangles whose true niche is asked for.
using FloodStarts = std::vector<std::pair<TriangleIndex, TriangleIndex>>;

/// The visible niches at a pose, and in which of them each start lies: decided by the same flood over all
/// triangle pairs.
LocalMinima trueNiches(const BenchmarkPair& pair, const Eigen::Isometry3d& pose, double cutoff,
                       FloodStarts starts, double least_prominence = kLeastTrueProminence);

struct FloodComparison {
  LocalMinima truth;
  std::vector<std::size_t> missed;  ///< indices of true niches that nothing reported lies in
};

/// Compares the niches of a solution with the true ones and adds to `shares`.
FloodComparison compareWithFlood(const BenchmarkPair& pair, const Eigen::Isometry3d& pose, double cutoff,
                                 const PairSolution& solution, RecallShares& shares);

}  // namespace concave_distance::benchmark
