#pragma once

#include "distance/kernels/pair_frame.h"
#include "local_minima.h"

namespace concave_distance::detail {

/// Computes what is reported of a niche besides its place: kind, extent, direction and visibility.
class NicheDescriber {
 public:
  void begin(const PairFrame& frame, const LocalMinimaRequest& request);

  /// @param minimum with its pass and level in `niche` already
  /// @param met_by_search no cone has led to it: it may be a minimum through material
  /// @param is_seen the segment between its points is known to meet neither body
  /// @return false for what is not wanted
  bool describe(const PairFrame& frame, const LocalMinimaRequest& request, const MinimumCandidate& minimum,
                bool met_by_search, bool is_seen, LocalMinimum& niche, WorkLimit& limit);

 private:
  /// Kind and extent; the place of a set is its middle.
  template <typename IsClear>
  void showCorner(const PairFrame& frame, LocalMinimum& niche, const IsClear& is_clear, WorkLimit& limit);
  void measure(const PairFrame& frame, LocalMinimum& niche, WorkLimit& limit);

  bool all_outward_ = false;  ///< every minimum that the cones lead to leaves both bodies outwards
  RefinementWorkspace refinement_;
  ExtentWorkspace extent_;
};

}  // namespace concave_distance::detail
