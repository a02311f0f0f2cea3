#pragma once

#include <concave_distance/PairNiches.h>
#include <concave_distance/PairStatus.h>

#include <memory>
#include <string>
#include <vector>

#include "concave_distance/scene/tracked_pair.h"
#include "conversions.h"

namespace concave_distance {

/// A tracked pair with what its messages say besides: names, stamp, frames.
struct PublishedPair {
  PublishedPair(const Scene& scene, const ScenePair& pair, const std::string& reference_frame);
  PublishedPair(std::shared_ptr<const TrackedPair> tracked_pair, const std::string& reference_frame);

  std::shared_ptr<const TrackedPair> tracked;  ///< not null in DistanceCycle::pairs()
  PairHeading heading;                         ///< of the last answer
  PairStatus status;                           ///< why there is no solution; OK when there is
  bool was_watched = false;                    ///< before the last cycle

  const PairDemand& demand() const { return tracked->demand; }
};

/// Returns what the node says of the pair: its answer, or why there is none.
PairNiches toNiches(const PublishedPair& pair);

/// In the order of SceneTracker::pairs(): that of scene.pairs, then near pairs by rule.
using PublishedPairs = std::vector<std::unique_ptr<PublishedPair>>;

}  // namespace concave_distance
