#include "body_publisher.h"

#include <visualization_msgs/MarkerArray.h>

#include <optional>

#include "ros/markers/body_markers.h"

namespace concave_distance {
namespace {

constexpr double kAtRest = 1.0;  // s without a move after which the bodies are taken to rest

}  // namespace

BodyPublisher::BodyPublisher(ros::NodeHandle& node)
    : publisher_(node.advertise<visualization_msgs::MarkerArray>("body_markers", 1, true)) {}

void BodyPublisher::publish(const std::shared_ptr<const Scene>& scene, bool with_collision) {
  const std::uint32_t subscribers = publisher_.getNumSubscribers();
  const bool has_new = subscribers > shown_to_;
  shown_to_ = subscribers;
  if (subscribers == 0) return;
  const bool has_changed = scene != shown_scene_;
  if (has_changed && shown_scene_ && !has_new && sendMoved(*scene, with_collision)) {
    shown_scene_ = scene;
    return;
  }
  const bool is_partial = !last_moved_.isZero();
  const bool rests = is_partial && (ros::WallTime::now() - last_moved_).toSec() > kAtRest;
  if (!has_changed && !rests && !(has_new && is_partial)) return;
  publisher_.publish(bodyMarkers(*scene, with_collision));
  last_moved_ = {};
  shown_scene_ = scene;
}

bool BodyPublisher::sendMoved(const Scene& scene, bool with_collision) {
  const auto moved = movedBodyMarkers(*shown_scene_, scene, with_collision);
  if (!moved) return false;
  if (moved->markers.empty()) return true;
  publisher_.publish(*moved);
  last_moved_ = ros::WallTime::now();
  return true;
}

}  // namespace concave_distance
