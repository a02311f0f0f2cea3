#include "body_markers.h"

#include <algorithm>
#include <optional>
#include <tuple>
#include <vector>

#include "marker_parts.h"
#include "niche_markers.h"
#include "ros/messages/conversions.h"

namespace concave_distance {
namespace {

constexpr float kBoxOpacity = 0.3F;
constexpr float kWarningOpacity = 0.4F;
constexpr double kSeenThroughOpacity = 0.5;
// Distance of collision geometry from the surface over its diameter: rviz may draw the same one.
constexpr double kCollisionOffset = 0.002;
const Eigen::Vector4d kCollisionColour(0.1, 0.4, 0.9, 0.35);

// Outward unit vectors at the vertices; 0 where the normals of the faces around cancel out.
std::vector<Eigen::Vector3d> vertexNormals(const SurfaceMesh& surface) {
  std::vector<Eigen::Vector3d> normals(surface.vertexCount(), Eigen::Vector3d::Zero());
  for (const TriangleNodes& triangle : surface.triangles()) {
    const Eigen::Vector3d& a = surface.vertex(triangle[0]);
    const Eigen::Vector3d area = (surface.vertex(triangle[1]) - a).cross(surface.vertex(triangle[2]) - a);
    for (const NodeIndex node : triangle) normals[node.value] += area;
  }
  for (Eigen::Vector3d& normal : normals) normal.normalize();
  return normals;
}

// Pairs that are looked at for what covers their pressure.
constexpr std::size_t kMostPairsTried = 10'000;

bool pressesOnEachOther(const ScenePair& pair) {
  const std::optional<NormalForceSettings>& force = pair.settings.effects.normal_force;
  return force && force->distribution == ForceDistribution::Pressure;
}

std::vector<double> opacities(const Scene& scene) {
  std::vector<double> result;
  result.reserve(scene.bodies.size());
  for (const SceneBody& body : scene.bodies) result.push_back(body.colour[3]);
  const bool may_press_by_rule = std::any_of(
      scene.rules.list.begin(), scene.rules.list.end(),
      [&](const PairRule& rule) { return rule.is_watched && settingsOf(scene, rule).effects.normal_force; });
  for (const ScenePair& pair : may_press_by_rule ? allPairs(scene, kMostPairsTried) : scene.pairs) {
    if (!pressesOnEachOther(pair)) continue;
    double& opacity = result[seenThrough(scene, pair)];
    opacity = std::min(opacity, kSeenThroughOpacity);
  }
  return result;
}

// The surface's triangles, moved outwards by `offset` metres; its bounding box, translucent, when there are
// too many of them.
void drawSurface(const SurfaceMesh& surface, double offset, visualization_msgs::Marker& marker) {
  if (surface.triangleCount() > kLargestShownBody) {
    marker.type = visualization_msgs::Marker::CUBE;
    marker.pose.position = toPoint(surface.boundingBox().center());
    marker.scale = toVector(surface.boundingBox().sizes() + Eigen::Vector3d::Constant(2.0 * offset));
    marker.color.a = kBoxOpacity;
    return;
  }
  marker.type = visualization_msgs::Marker::TRIANGLE_LIST;
  marker.scale.x = marker.scale.y = marker.scale.z = 1.0;
  marker.points.reserve(3 * surface.triangleCount());
  std::vector<Eigen::Vector3d> vertices = surface.vertices();
  if (offset != 0.0) {
    const std::vector<Eigen::Vector3d> normals = vertexNormals(surface);
    for (std::size_t k = 0; k < vertices.size(); ++k) vertices[k] += offset * normals[k];
  }
  for (const TriangleNodes& triangle : surface.triangles()) {
    for (const NodeIndex node : triangle) marker.points.push_back(toPoint(vertices[node.value]));
  }
}

void drawVoxels(const CloudState& cloud, visualization_msgs::Marker& marker) {
  marker.type = visualization_msgs::Marker::CUBE_LIST;
  const double size = cloud.voxel_size;
  marker.scale = toVector(Eigen::Vector3d::Constant(size));
  if (!cloud.hasVoxels()) {
    marker.action = visualization_msgs::Marker::DELETE;
    return;
  }
  marker.points.reserve(cloud.cells->size());
  for (const VoxelCell& cell : *cloud.cells) {
    const Eigen::Vector3d corner(cell[0], cell[1], cell[2]);
    marker.points.push_back(toPoint(size * (corner + Eigen::Vector3d::Constant(0.5))));
  }
}

visualization_msgs::Marker bodyMarker(const Scene& scene, std::size_t index, const char* ns,
                                      const std_msgs::ColorRGBA& color, double offset) {
  const SceneBody& body = scene.bodies[index];
  std_msgs::Header header;
  header.frame_id = body.frame;
  visualization_msgs::Marker marker = emptyMarker(header, ns, static_cast<std::int32_t>(index));
  marker.pose = toPose(body.frame_from_body);
  marker.frame_locked = 1;
  marker.color = color;
  if (body.cloud) {
    drawVoxels(*body.cloud, marker);
  } else {
    drawSurface(body.mesh->surface(), offset, marker);
  }
  return marker;
}

bool isDrawn(const SceneBody& body, bool with_collision) {
  return !body.in_robot_model || with_collision;
}

visualization_msgs::Marker markerOf(const Scene& scene, std::size_t index, double opacity) {
  const SceneBody& body = scene.bodies[index];
  if (body.in_robot_model) {
    return bodyMarker(scene, index, "collision", makeColor(kCollisionColour.head<3>(), kCollisionColour[3]),
                      kCollisionOffset * body.mesh->diameter());
  }
  return bodyMarker(scene, index, "bodies", makeColor(body.colour.head<3>(), opacity), 0.0);
}

}  // namespace

std::size_t seenThrough(const Scene& scene, const ScenePair& pair) {
  const auto rank = [&](std::size_t index) {
    const SceneBody& body = scene.bodies[index];
    return std::tuple(body.in_robot_model, body.colour[3], body.mesh->diameter());
  };
  return rank(pair.body_a) < rank(pair.body_b) ? pair.body_a : pair.body_b;
}

visualization_msgs::MarkerArray bodyMarkers(const Scene& scene, bool with_collision) {
  visualization_msgs::MarkerArray message;
  message.markers.push_back(emptyMarker(std_msgs::Header(), "", 0));
  message.markers.back().action = visualization_msgs::Marker::DELETEALL;
  const std::vector<double> opacity = opacities(scene);
  for (std::size_t index = 0; index < scene.bodies.size(); ++index) {
    if (isDrawn(scene.bodies[index], with_collision))
      message.markers.push_back(markerOf(scene, index, opacity[index]));
  }
  return message;
}

std::optional<visualization_msgs::MarkerArray> movedBodyMarkers(const Scene& shown, const Scene& now,
                                                                bool with_collision) {
  if (shown.bodies.size() != now.bodies.size()) return std::nullopt;
  const std::vector<double> opacity = opacities(now);
  if (opacity != opacities(shown)) return std::nullopt;
  visualization_msgs::MarkerArray message;
  for (std::size_t index = 0; index < now.bodies.size(); ++index) {
    const SceneBody& before = shown.bodies[index];
    const SceneBody& body = now.bodies[index];
    if (&before == &body) continue;
    if (before.name != body.name || before.colour != body.colour ||
        before.in_robot_model != body.in_robot_model || (before.mesh != body.mesh && !body.cloud)) {
      return std::nullopt;
    }
    const bool has_same_voxels = !body.cloud || (before.cloud && before.cloud->cells == body.cloud->cells);
    const bool is_there = before.frame == body.frame && has_same_voxels &&
                          before.frame_from_body.matrix() == body.frame_from_body.matrix();
    if (!is_there && isDrawn(body, with_collision))
      message.markers.push_back(markerOf(now, index, opacity[index]));
  }
  return message;
}

visualization_msgs::Marker warningMarker(const Scene& scene, std::size_t body, double offset) {
  std_msgs::ColorRGBA color = warningColor();
  color.a = kWarningOpacity;
  return bodyMarker(scene, body, "warning", color, offset);
}

}  // namespace concave_distance
