#pragma once

#include <concave_distance/PairStatus.h>

#include <memory>
#include <string>
#include <vector>

#include "concave_distance/scene/tracked_pair.h"
#include "conversions.h"
#include "ros/tf/tf_poses.h"

namespace concave_distance {

/// A tracked pair with what its messages say besides: names, stamp, frames.
struct PublishedPair {
  PublishedPair(const Scene& scene, const ScenePair& pair, const std::string& reference_frame);

  std::shared_ptr<const TrackedPair> tracked;  ///< not null in DistanceCycle::pairs()
  PairFrames frames;
  PairAncestors ancestors;
  PairHeading heading;  ///< of the last answer
  PairStatus status;    ///< why there is no solution; OK when there is
  ros::Time solved_stamp;

  const PairDemand& demand() const { return tracked->demand; }
};

/// In the order of scene.pairs.
using PublishedPairs = std::vector<std::unique_ptr<PublishedPair>>;

}  // namespace concave_distance
