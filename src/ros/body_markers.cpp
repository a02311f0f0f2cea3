#include "concave_distance/ros/body_markers.h"

#include "concave_distance/ros/conversions.h"

namespace concave_distance {
namespace {

constexpr float kBoxOpacity = 0.3F;

std_msgs::ColorRGBA toColor(const Eigen::Vector4d& color) {
  std_msgs::ColorRGBA message;
  message.r = static_cast<float>(color[0]);
  message.g = static_cast<float>(color[1]);
  message.b = static_cast<float>(color[2]);
  message.a = static_cast<float>(color[3]);
  return message;
}

void drawTriangles(const SurfaceMesh& surface, visualization_msgs::Marker& marker) {
  marker.type = visualization_msgs::Marker::TRIANGLE_LIST;
  marker.scale.x = marker.scale.y = marker.scale.z = 1.0;
  marker.points.reserve(3 * surface.triangleCount());
  for (const TriangleNodes& triangle : surface.triangles()) {
    for (const NodeIndex node : triangle) {
      marker.points.push_back(toPoint(surface.vertex(node)));
    }
  }
}

void drawBox(const SurfaceMesh& surface, visualization_msgs::Marker& marker) {
  marker.type = visualization_msgs::Marker::CUBE;
  marker.pose.position = toPoint(surface.boundingBox().center());
  marker.scale = toVector(surface.boundingBox().sizes());
  marker.color.a = kBoxOpacity;
}

}  // namespace

visualization_msgs::MarkerArray bodyMarkers(const Scene& scene) {
  visualization_msgs::MarkerArray message;
  visualization_msgs::Marker clear;
  clear.action = visualization_msgs::Marker::DELETEALL;
  clear.pose.orientation.w = 1.0;
  message.markers.push_back(clear);
  for (std::size_t index = 0; index < scene.bodies.size(); ++index) {
    const SceneBody& body = scene.bodies[index];
    if (body.in_robot_model) {
      continue;
    }
    visualization_msgs::Marker marker;
    marker.header.frame_id = body.frame;
    marker.frame_locked = 1;
    marker.ns = "bodies";
    marker.id = static_cast<std::int32_t>(index);
    marker.action = visualization_msgs::Marker::ADD;
    marker.pose.orientation.w = 1.0;
    marker.color = toColor(body.colour);
    if (body.mesh->surface().triangleCount() > kLargestShownBody) {
      drawBox(body.mesh->surface(), marker);
    } else {
      drawTriangles(body.mesh->surface(), marker);
    }
    message.markers.push_back(std::move(marker));
  }
  return message;
}

}  // namespace concave_distance
