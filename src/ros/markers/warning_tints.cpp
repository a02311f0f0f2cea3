#include "warning_tints.h"

#include <cmath>
#include <utility>

#include "body_markers.h"
#include "niche_markers.h"
#include "ros/time_difference.h"

namespace concave_distance {
namespace {

constexpr float kOpacity = 0.4F;
constexpr double kLives = 3.0;  // lifetime of a copy, in renewals

}  // namespace

std::set<std::size_t> warnedBodies(const Scene& scene, const std::vector<DrawnPair>& drawn, double largest) {
  std::set<std::size_t> bodies;
  for (const DrawnPair& pair : drawn) {
    const std::optional<std::size_t> found = scene.pairs.find(pair.pair->nearest.pair);
    if (pair.pair->nearest.warning == 0 || !found) continue;
    const ScenePair& ends = scene.pairs[*found];
    const bool a_is_link = scene.bodies[ends.body_a].is_robot_link;
    const bool b_is_link = scene.bodies[ends.body_b].is_robot_link;
    const std::size_t obstacle = a_is_link ? ends.body_b : ends.body_a;
    if (a_is_link != b_is_link && bodies.count(obstacle) != 0) continue;  // by a nearer link
    bodies.insert({ends.body_a, ends.body_b});
  }
  for (auto body = bodies.begin(); body != bodies.end();) {
    body = scene.bodies[*body].mesh->diameter() > largest ? bodies.erase(body) : std::next(body);
  }
  return bodies;
}

std::vector<visualization_msgs::Marker> WarningTints::update(const Scene& scene,
                                                             const std::set<std::size_t>& warned,
                                                             double offset, double renewal,
                                                             const std_msgs::Header& header) {
  std::vector<visualization_msgs::Marker> markers;
  // Also after the clock has jumped back.
  const bool renews = std::abs(secondsBetween(renewed_, header.stamp)) >= renewal;
  if (renews) renewed_ = header.stamp;
  const std::map<std::int32_t, std::string> before = std::exchange(shown_, {});
  for (const std::size_t index : warned) {
    const SceneBody& body = scene.bodies[index];
    const auto id = static_cast<std::int32_t>(index);
    shown_[id] = body.name;
    const auto found = before.find(id);
    if (!renews && found != before.end() && found->second == body.name) continue;
    visualization_msgs::Marker& marker =
        markers.emplace_back(emptyMarker(header, "warning", id, kLives * renewal));
    marker.header.frame_id = body.frame;
    marker.header.stamp = ros::Time();
    marker.frame_locked = 1;
    drawSurface(body.mesh->surface(), offset, marker);
    marker.color = warningColor();
    marker.color.a = kOpacity;
  }
  for (const auto& [id, name] : before) {
    if (shown_.count(id) != 0) continue;
    markers.push_back(emptyMarker(header, "warning", id, 0.0));
    markers.back().action = visualization_msgs::Marker::DELETE;
  }
  return markers;
}

}  // namespace concave_distance
