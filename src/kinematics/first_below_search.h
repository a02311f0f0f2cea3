#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "gap_queue.h"
#include "gap_sampler.h"

namespace concave_distance::detail {

/// Narrows down when a distance of a motion is first below a threshold: the gaps that may reach it are
/// sampled in the order of time.
class FirstBelowSearch {
 public:
  /// @param threshold metres
  FirstBelowSearch(GapSampler& sampler, double threshold);

  struct First {
    double proven_until = 0.0;     ///< moment
    std::optional<double> moment;  ///< at which a pair is below
    std::size_t pair = 0;
  };
  /// @param gaps all in which a distance may be below the threshold @param progress is reported meanwhile
  First find(const std::vector<ClearanceGap>& gaps, const ClearanceProgress& progress);

 private:
  void note(const ClearanceSample& sample, std::size_t pair);
  void add(const ClearanceGap& gap);
  bool isLate(const ClearanceGap& gap) const;
  void narrow(const ClearanceGap& gap, GapJob& job, ClearanceWorkspace& workspace) const;

  GapSampler& sampler_;
  double threshold_;
  First first_;
  GapQueue open_;
  std::vector<GapJob> jobs_;
};

}  // namespace concave_distance::detail
