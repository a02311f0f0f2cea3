#pragma once

#include <ros/node_handle.h>

#include <memory>
#include <vector>

#include "cloud_receiver.h"

namespace concave_distance {

/// Follows all clouds of the scene that is served.
class CloudReceivers {
 public:
  CloudReceivers(const ros::NodeHandle& node, SceneStore& keeper, const TransformBuffer& transforms,
                 double transform_timeout);

  /// Subscribes to the clouds of a scene that are not followed yet, and ends those that are gone.
  void follow(const Scene& scene);
  std::vector<CloudReport> take();

 private:
  ros::NodeHandle node_;
  SceneStore& keeper_;
  const TransformBuffer& transforms_;
  double transform_timeout_;
  std::vector<std::unique_ptr<CloudReceiver>> receivers_;
};

}  // namespace concave_distance
