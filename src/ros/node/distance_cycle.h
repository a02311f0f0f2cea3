#pragma once

#include <ros/time.h>

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "concave_distance/scene/scene.h"
#include "concave_distance/scene/scene_tracker.h"
#include "ros/messages/published_pair.h"

namespace concave_distance {

struct CycleOptions {
  std::string reference_frame;
  double stale_after = 1.0;                 ///< s
  std::uint32_t threads = 0;                ///< that solve pairs; 0: one per core, 1: only the caller's
  const std::atomic<bool>* stop = nullptr;  ///< set: a cycle ends without solving the pairs that are left
  bool prepares_in_background = false;      ///< as SceneTrackerOptions
};

/// Tracks the pairs of a scene at the poses that tf2 knows. Knows the transforms but no topic. One thread at
/// a time.
class DistanceCycle {
 public:
  DistanceCycle(const TransformBuffer& transforms, CycleOptions options);

  /// As SceneTracker::setScene.
  void setScene(const Scene& scene, bool settings_changed = true);
  /// As SceneTracker::update, at the newest transforms.
  CycleCounts run(const std::vector<PairDemand>& demand, ros::Time now,
                  WorkLimit::Clock::time_point end = kNoCycleEnd);

  /// Every pair, or the one at this place in scene.pairs, starts cold in its next cycle.
  void restart() { tracker_.restart(); }
  void restart(std::size_t pair) { tracker_.restart(pair); }

  const PublishedPairs& pairs() const { return pairs_; }
  /// Pairs that left the scene with an alert raised, which setScene took back; reported once.
  PublishedPairs takeRetired();

 private:
  PairInput locate(PublishedPair& pair, const tf2::BufferCore& buffer, ros::Time now) const;
  static void describe(PublishedPair& pair, bool was_watched);

  const TransformBuffer& transforms_;
  CycleOptions options_;
  SceneTracker tracker_;
  PublishedPairs pairs_;
  PublishedPairs retired_;
  std::vector<bool> was_watched_;
};

}  // namespace concave_distance
