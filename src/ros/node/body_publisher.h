#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <cstdint>
#include <memory>

#include "concave_distance/scene/scene.h"

namespace concave_distance {

/// Publishes the latched topic `body_markers`. While edits only place bodies elsewhere it sends the markers
/// of these alone, and all again when they have come to rest or somebody new listens.
class BodyPublisher {
 public:
  explicit BodyPublisher(ros::NodeHandle& node);

  /// Sends what has changed since the last call, if anybody listens.
  void publish(const std::shared_ptr<const Scene>& scene, bool with_collision);

 private:
  /// Returns whether all that has changed since shown_scene_ was sent, or nothing had to be.
  bool sendMoved(const Scene& scene, bool with_collision);

  ros::Publisher publisher_;
  std::shared_ptr<const Scene> shown_scene_;
  std::uint32_t shown_to_ = 0;  ///< subscribers
  ros::WallTime last_moved_;    ///< when moved bodies alone were sent; zero: the last message had all bodies
};

}  // namespace concave_distance
