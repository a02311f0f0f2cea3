#pragma once

#include <ros/time.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "concave_distance/scene/scene.h"
#include "concave_distance/scene/scene_tracker.h"
#include "ros/messages/published_pair.h"
#include "ros/tf/tf_locate.h"

namespace concave_distance {

struct CycleOptions {
  std::string reference_frame;
  double stale_after = 1.0;                 ///< s
  std::uint32_t threads = 0;                ///< that solve pairs; 0: one per core, 1: only the caller's
  const std::atomic<bool>* stop = nullptr;  ///< set: a cycle ends without solving the pairs that are left
  bool prepares_in_background = false;      ///< as SceneTrackerOptions
};

/// Tracks a scene at the poses that tf2 knows. Knows the transforms but no topic. One thread at
/// a time.
class DistanceCycle {
 public:
  DistanceCycle(const TransformBuffer& transforms, CycleOptions options);

  /// As SceneTracker::setScene.
  void setScene(const Scene& scene, bool settings_changed = true);
  /// As SceneTracker::update, at the newest transforms.
  CycleCounts run(const SceneTracker::DemandOf& demand_of, ros::Time now,
                  WorkLimit::Clock::time_point end = kNoCycleEnd);
  /// @param demand of the first pairs; nothing is wanted of the others
  CycleCounts run(const std::vector<PairDemand>& demand, ros::Time now,
                  WorkLimit::Clock::time_point end = kNoCycleEnd);

  /// Every pair, or the one at this place in pairs(), starts cold in its next cycle.
  void restart() { tracker_.restart(); }
  void restart(std::size_t pair) { tracker_.restart(pair); }

  const PublishedPairs& pairs() const { return pairs_; }
  const SceneTracker::Pairs& trackedPairs() const { return tracker_.pairs(); }
  /// Where the bodies were in the last run().
  TfLocate& located() { return locate_; }
  /// Counts the pairs by rule that pairs() does not have.
  const OtherPairs& others() const { return tracker_.others(); }
  /// Pairs that left the scene with an alert raised, which setScene took back; reported once.
  PublishedPairs takeRetired();

 private:
  /// A body that is a cloud.
  struct Cloud {
    std::size_t body;
    std::string name;
    std::shared_ptr<const CloudState> state;
  };
  void hideUnusableClouds(ros::Time now);
  void followPairs();
  void describe(PublishedPair& pair);

  const TransformBuffer& transforms_;
  CycleOptions options_;
  SceneTracker tracker_;
  TfLocate locate_;
  std::vector<Cloud> clouds_;
  PublishedPairs pairs_;
  PublishedPairs spare_;  ///< of an earlier order, for followPairs()
  PublishedPairs retired_;
};

}  // namespace concave_distance
