#pragma once

#include <ros/time.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "cycle_timer.h"
#include "distance_cycle.h"
#include "ros/topics/scene_store.h"
#include "ros/topics/topic_publishers.h"
#include "scene/cycle_statistics.h"
#include "scene/restart_requests.h"

namespace concave_distance {

/// Runs the cycle on its own thread, so that no service delays it, at a rate of ROS time (with use_sim_time,
/// of simulated time).
class CycleRunner {
 public:
  CycleRunner(TransformBuffer& transforms, SceneStore& keeper, TopicPublishers& publishers,
              RestartRequests& restarts, const CycleOptions& options,
              const std::optional<double>& cycle_budget);
  CycleRunner(const CycleRunner&) = delete;
  CycleRunner& operator=(const CycleRunner&) = delete;

  void start(double rate);
  /// Takes effect with the next cycle.
  void setRates(double rate, double marker_rate);
  /// Likewise. @param contacts draw contacts beside the niches, while markers are published
  void setMarkers(bool publish, bool contacts);
  double rate() const { return rate_; }
  CycleStatistics& statistics() { return statistics_; }

 private:
  void runTimedCycle(std::int64_t due);
  /// @return whether the scene changed
  bool adoptScene();
  /// A clock that jumps back (a bag that starts over, a simulation that is reset) invalidates every transform
  /// and every warm state.
  void checkClock(ros::Time now);
  /// @param start of the cycle
  CycleRecord runCycle(ros::Time now, WorkLimit::Clock::time_point start);

  TransformBuffer& transforms_;
  SceneStore& keeper_;
  TopicPublishers& publishers_;
  RestartRequests& restarts_;
  CycleStatistics statistics_;
  std::optional<double> cycle_budget_;  ///< s, as NodeParameters::cycle_budget
  std::atomic<double> rate_{50.0};
  std::atomic<double> marker_rate_{20.0};
  std::atomic<bool> publish_markers_{true};
  std::atomic<bool> contact_markers_{true};

  // The cycle's thread alone uses these.
  DistanceCycle cycle_;
  std::shared_ptr<const ServedScene> served_;
  ros::Time last_now_;
  std::uint64_t cycles_until_markers_ = 0;
  bool was_idle_ = false;

  CycleTimer timer_;  ///< last member: it stops before what it calls is destroyed
};

}  // namespace concave_distance
