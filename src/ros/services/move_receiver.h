#pragma once

#include <concave_distance/SceneMoves.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>

#include "base/log_throttle.h"
#include "ros/tf/transform_buffer.h"
#include "ros/topics/move_report.h"
#include "ros/topics/scene_store.h"
#include "service_queues.h"

namespace concave_distance {

/// Subscribes to `scene_moves` and applies its moves to the scene, each message in one edit; a move that is
/// refused leaves the others. Logs what is refused.
class MoveReceiver {
 public:
  MoveReceiver(ServiceQueues& queues, SceneStore& keeper, const TransformBuffer& transforms,
               std::string reference_frame);

  /// Returns what arrived since the last call.
  MoveReport take();

 private:
  void receive(const SceneMoves& moves);
  /// @return how many were applied
  std::size_t apply(const SceneMoves& moves);
  void note(const std::string& body, const std::string& problem);

  SceneStore& keeper_;
  const TransformBuffer& transforms_;
  std::string reference_frame_;
  std::mutex mutex_;
  MoveReport report_;
  LogThrottle throttle_;
  ros::NodeHandle node_;
  ros::Subscriber moves_;  ///< last member: no message comes before the others are there
};

}  // namespace concave_distance
