#pragma once

#include "local_minima.h"
#include "minima_scene.h"

namespace concave_distance::detail {

/// Computes what is reported of a niche besides its place: kind, extent, direction and visibility.
class NicheDescriber {
 public:
  /// @param minimum with its pass and level in `niche` already
  /// @return false for what is not wanted
  bool describe(const MinimaScene& scene, const LocalMinimaRequest& request, const MinimumSeed& minimum,
                LocalMinimum& niche, WorkLimit& limit);

 private:
  /// Kind and extent; the place of a set is its middle.
  void measure(const MinimaScene& scene, LocalMinimum& niche, WorkLimit& limit);

  RefinementWorkspace refinement_;
  ExtentWorkspace extent_;
};

}  // namespace concave_distance::detail
