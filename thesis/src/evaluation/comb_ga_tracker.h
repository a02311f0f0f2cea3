#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <string>

#include "concave_distance/tracking/pair_solution.h"
#include "concave_distance/tracking/tracker_parameters.h"
#include "thesis/src/genetic/comb_ga_parameters.h"
#include "tracking/pair_cycle.h"
#include "tracking/recentred_pair.h"

namespace concave_distance::evaluation {

/// A PairTracker that searches with comb-GA in any of its variants.
class CombGaTracker {
 public:
  /// @param parameters their cold and warm are partOfCore() of the next two
  /// @param cold, warm what searches in the first cycle and in further ones
  CombGaTracker(const std::string& name, const std::shared_ptr<const BodyMesh>& a,
                const std::shared_ptr<const BodyMesh>& b, const TrackerParameters& parameters,
                const CombGaParameters& cold, const CombGaParameters& warm);

  /// As PairTracker::update().
  void update(const Eigen::Isometry3d& a_from_b, double time, PairSolution& solution);
  void reset() { cycle_.reset(); }
  const TrackerParameters& parameters() const { return cycle_.parameters(); }

 private:
  RecentredPair bodies_;
  PairCycle cycle_;
};

}  // namespace concave_distance::evaluation
