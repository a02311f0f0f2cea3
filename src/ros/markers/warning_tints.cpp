#include "warning_tints.h"

#include <iterator>

#include "body_markers.h"
#include "niche_markers.h"

namespace concave_distance {
namespace {

constexpr float kOpacity = 0.4F;
constexpr double kLives = 3.0;  // lifetime of a copy, in renewals

visualization_msgs::Marker emptyTint(std::int32_t id, const std::string& frame) {
  visualization_msgs::Marker marker;
  marker.header.frame_id = frame;
  marker.ns = "warning";
  marker.id = id;
  marker.pose.orientation.w = 1.0;
  return marker;
}

visualization_msgs::Marker drawTint(const SceneBody& body, std::int32_t id, double offset, double lifetime) {
  visualization_msgs::Marker marker = emptyTint(id, body.frame);
  marker.frame_locked = 1;
  marker.action = visualization_msgs::Marker::ADD;
  marker.lifetime = ros::Duration(lifetime);
  drawSurface(body.mesh->surface(), offset, marker);
  marker.color = warningColor();
  marker.color.a = kOpacity;
  return marker;
}

}  // namespace

std::vector<visualization_msgs::Marker> WarningTints::update(const Scene& scene,
                                                             const std::set<std::size_t>& warned,
                                                             double offset, double renewal, ros::Time now) {
  std::vector<visualization_msgs::Marker> markers;
  for (auto shown = shown_.begin(); shown != shown_.end();) {
    const auto index = static_cast<std::size_t>(shown->first);
    const bool stays = warned.count(index) != 0 && scene.bodies[index].name == shown->second.body;
    if (!stays) {
      markers.push_back(emptyTint(shown->first, shown->second.frame));
      markers.back().action = visualization_msgs::Marker::DELETE;
    }
    shown = stays ? std::next(shown) : shown_.erase(shown);
  }
  for (const std::size_t index : warned) {
    const auto id = static_cast<std::int32_t>(index);
    Tint& tint = shown_[id];
    const bool fresh = !tint.sent.isZero() && now >= tint.sent && (now - tint.sent).toSec() < renewal;
    if (fresh) continue;
    const SceneBody& body = scene.bodies[index];
    markers.push_back(drawTint(body, id, offset, kLives * renewal));
    tint = {body.name, body.frame, now};
  }
  return markers;
}

}  // namespace concave_distance
