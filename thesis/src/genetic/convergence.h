#pragma once

#include <cstdint>
#include <vector>

#include "search/trial_point_table.h"

namespace concave_distance {

/// Tells when a run has stopped finding anything: neither the best place nor the set of niches (greedy
/// identification with the niche radius) has changed for some generations.
class ConvergenceCheck {
 public:
  /// @param generations without change after which a run has converged; 0: never
  void reset(std::uint32_t generations);
  /// Call once a generation. True when the run has converged.
  bool update(const Census& census, double niche_radius, TrialPointTable& places, PairMetric& metric);

 private:
  std::uint32_t generations_ = 0;
  std::uint32_t unchanged_ = 0;
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> niches_;  ///< places of the niches' best points, best first
  std::vector<std::uint32_t> last_niches_;
};

}  // namespace concave_distance
