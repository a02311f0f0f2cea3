#pragma once

#include <vector>

#include "distance/kernels/minima_scene.h"
#include "distance/minima/cone_front.h"
#include "far_pieces.h"
#include "local_minima.h"
#include "meeting_pairs.h"

namespace concave_distance::detail {

/// Whether a minimum that was found elsewhere, by a search or at an earlier pose, can be a niche.
bool isCandidate(const MinimaScene& scene, const LocalMinimaRequest& request, const MinimumSeed& seed);
/// Appends those of `from` that can be niches.
void appendCandidates(const MinimaScene& scene, const LocalMinimaRequest& request,
                      const std::vector<MinimumSeed>& from, std::vector<MinimumSeed>& seeds);

/// Collects the triangle pairs in which local minima of the distance may lie. Belongs to one pair of bodies:
/// it keeps its buffers and, of a tracked pair, what the next pose can use.
class SeedCollector {
 public:
  /// @param seeds replaced, in no order, some more than once. @return false when the limit was reached
  bool collect(const MinimaScene& scene, const LocalMinimaRequest& request, std::vector<MinimumSeed>& seeds,
               LocalMinimaCost& cost, WorkLimit& limit);
  void clear() { front_.clear(); }
  std::size_t memoryBytes() const {
    return front_.memoryBytes() + far_pieces_.memoryBytes() + open_.capacity() * sizeof(TreeNodePair);
  }

 private:
  ConeFront front_;
  FarPieceBuffers far_pieces_;
  std::vector<TreeNodePair> open_;
};

}  // namespace concave_distance::detail
