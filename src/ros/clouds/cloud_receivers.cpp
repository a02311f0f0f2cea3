#include "cloud_receivers.h"

#include <algorithm>

namespace concave_distance {

CloudReceivers::CloudReceivers(const ros::NodeHandle& node, SceneStore& keeper,
                               const TransformBuffer& transforms, double transform_timeout)
    : node_(node), keeper_(keeper), transforms_(transforms), transform_timeout_(transform_timeout) {}

void CloudReceivers::follow(const Scene& scene) {
  const auto end = std::remove_if(receivers_.begin(), receivers_.end(), [&](const auto& receiver) {
    return std::none_of(scene.bodies.begin(), scene.bodies.end(),
                        [&](const SceneBody& body) { return receiver->isOf(body); });
  });
  receivers_.erase(end, receivers_.end());
  for (const SceneBody& body : scene.bodies) {
    if (!body.cloud) continue;
    const bool is_followed = std::any_of(receivers_.begin(), receivers_.end(),
                                         [&](const auto& receiver) { return receiver->isOf(body); });
    if (is_followed) continue;
    receivers_.push_back(
        std::make_unique<CloudReceiver>(node_, body, keeper_, transforms_, transform_timeout_));
  }
}

std::vector<CloudReport> CloudReceivers::take() {
  std::vector<CloudReport> reports;
  reports.reserve(receivers_.size());
  for (const auto& receiver : receivers_) reports.push_back(receiver->take());
  return reports;
}

}  // namespace concave_distance
