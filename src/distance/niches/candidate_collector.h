#pragma once

#include <vector>

#include "convex_shell_pairs.h"
#include "distance/kernels/pair_frame.h"
#include "distance/minima/minima_tracker.h"
#include "distant_components.h"
#include "local_minima.h"
#include "overlap_parts.h"

namespace concave_distance::detail {

/// Tells whether a minimum that was found elsewhere, by a search or at an earlier pose, can be a niche.
bool isCandidate(const PairFrame& frame, const LocalMinimaRequest& request,
                 const MinimumCandidate& candidate);
/// Appends those of `from` that can be niches.
void appendCandidates(const PairFrame& frame, const LocalMinimaRequest& request,
                      const std::vector<MinimumCandidate>& from, std::vector<MinimumCandidate>& candidates);

/// Collects the triangle pairs in which local minima of the distance may lie. Belongs to one pair of bodies:
/// it keeps its buffers and, of a tracked pair, what the next pose can use.
class CandidateCollector {
 public:
  /// @param candidates replaced, in no order, some more than once. @return false when the limit was reached
  bool collect(const PairFrame& frame, const LocalMinimaRequest& request,
               std::vector<MinimumCandidate>& candidates, LocalMinimaCost& cost, WorkLimit& limit);
  /// Returns where the bodies meet, at the pose of the last collect().
  const OverlapParts& overlap() const { return overlap_; }
  /// Begins the front of cones anew beside the one that has grown, as long as the limit allows and for as
  /// much work as that one took; a later call goes on, and when the new one is whole it takes the other's
  /// place.
  void renew(const PairFrame& frame, const LocalMinimaRequest& request, LocalMinimaCost& cost,
             const WorkLimit& limit);
  void clear() {
    front_.clear();
    next_front_.clear();
    shell_pairs_.clear();
    overlap_.findNone();
  }

 private:
  bool collectOverlap(const PairFrame& frame, const LocalMinimaRequest& request,
                      std::vector<MinimumCandidate>& candidates, LocalMinimaCost& cost, WorkLimit& limit);
  bool collectMinima(const PairFrame& frame, const LocalMinimaRequest& request,
                     std::vector<MinimumCandidate>& candidates, LocalMinimaCost& cost, WorkLimit& limit);

  MinimaTracker front_;
  MinimaTracker next_front_;
  std::vector<MinimumCandidate> next_candidates_;
  ConvexShellPairs shell_pairs_;
  DistantComponentBuffers distant_components_;
  OverlapParts overlap_;
};

}  // namespace concave_distance::detail
