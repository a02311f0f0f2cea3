#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "concave_distance/base/work_limit.h"
#include "concave_distance/interference/interference.h"
#include "concave_distance/tracking/pair_solution.h"
#include "distance/kernels/pair_frame.h"
#include "interference/deepest_place.h"

namespace concave_distance {

/// Gives each niche its signed value (SignedPlace), and keeps since when it has not jumped.
class SignedValues {
 public:
  struct Cycle {
    std::uint64_t number;
    double displacement;  ///< metres that any point of B has moved since the last one, at most
  };
  /// @param solution before margins are taken off its distances
  void update(const detail::PairFrame& frame, const Cycle& cycle, PairSolution& solution, WorkLimit& limit);
  void clear() {
    before_.clear();
    has_regions_ = false;
  }

 private:
  struct Known {
    std::uint64_t id;
    double value;
    std::uint64_t since_cycle;
  };

  void findRegions(const detail::PairFrame& frame, WorkLimit& limit);
  SignedPlace ofOverlap(const detail::PairFrame& frame, const TrackedNiche& niche, WorkLimit& limit);
  std::size_t regionAt(const detail::PairFrame& frame, const TrackedNiche& niche) const;
  SignedPlace ofRegion(const detail::PairFrame& frame, const InterferenceRegion& region, WorkLimit& limit);
  void keepAges(const Cycle& cycle, double rounding, PairSolution& solution);

  std::unique_ptr<InterferenceWorkspace> workspace_;  ///< nullptr: no overlap yet
  Interference overlap_;
  detail::DeepestPlaceSearch search_;
  std::vector<SignedPlace> values_;  ///< of overlap_.regions; not asked for where no niche has
  bool has_regions_ = false;         ///< all of them, at pose_
  Eigen::Isometry3d pose_ = Eigen::Isometry3d::Identity();
  std::vector<Known> before_;
  std::vector<Known> now_;
};

}  // namespace concave_distance
