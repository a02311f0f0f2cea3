#include "concave_distance/ros/niche_markers.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "concave_distance/ros/conversions.h"

namespace concave_distance {
namespace {

constexpr double kScaleShare = 0.02;  // of the median body diameter
constexpr double kLineShare = 0.35;   // line width over the diameter of the points
constexpr double kOtherShare = 0.55;  // size of the niches that are not the nearest
constexpr float kOtherOpacity = 0.6F;
constexpr double kTextShare = 2.5;  // letter height over the diameter of the points
constexpr double kRimShare = 0.15;  // line width of the circles around a segment or patch
constexpr int kRimCorners = 24;

struct DrawnNiche {
  std::int32_t id;
  double distance;
  geometry_msgs::Point point_a;
  geometry_msgs::Point point_b;
  bool nearest;
  double extent;  // metres, 0 for a point
  Eigen::Vector3d normal;
};

std::int32_t markerId(std::uint64_t niche_id) {
  return static_cast<std::int32_t>(niche_id & 0x7fffffffU);
}

std::string distanceText(double distance) {
  char text[32];
  if (distance < 0.01) {
    std::snprintf(text, sizeof(text), "%.2f mm", 1000.0 * distance);
  } else {
    std::snprintf(text, sizeof(text), "%.3f m", distance);
  }
  return text;
}

std::vector<DrawnNiche> drawnNiches(const PairNiches& pair) {
  std::vector<DrawnNiche> drawn;
  if (pair.nearest.has_distance == 0) {
    return drawn;
  }
  for (const Niche& niche : pair.niches) {
    drawn.push_back({markerId(niche.id), niche.distance, niche.point_a, niche.point_b, drawn.empty(),
                     niche.kind == Niche::KIND_POINT ? 0.0 : niche.extent,
                     Eigen::Vector3d(niche.normal.x, niche.normal.y, niche.normal.z)});
  }
  const bool swallowed = pair.nearest.status.code == PairStatus::PENETRATING;
  if (drawn.empty() && swallowed && pair.nearest.has_points != 0) {
    drawn.push_back({0, pair.nearest.distance, pair.nearest.point_a, pair.nearest.point_b, true, 0.0,
                     Eigen::Vector3d::Zero()});
  }
  return drawn;
}

// Appends a circle around the normal as single lines.
void appendCircle(const geometry_msgs::Point& centre, const Eigen::Vector3d& normal, double radius,
                  std::vector<geometry_msgs::Point>& lines) {
  const Eigen::Vector3d x = radius * normal.unitOrthogonal();
  const Eigen::Vector3d y = normal.cross(x);
  const Eigen::Vector3d middle(centre.x, centre.y, centre.z);
  for (int k = 0; k < kRimCorners; ++k) {
    for (const int corner : {k, k + 1}) {
      const double angle = 2.0 * M_PI * corner / kRimCorners;
      lines.push_back(toPoint(middle + std::cos(angle) * x + std::sin(angle) * y));
    }
  }
}

visualization_msgs::Marker emptyMarker(const PairNiches& pair, const char* kind, std::int32_t id,
                                       double lifetime) {
  visualization_msgs::Marker marker;
  marker.header = pair.header;
  marker.ns = pair.nearest.pair + "/" + kind;
  marker.id = id;
  marker.action = visualization_msgs::Marker::ADD;
  marker.pose.orientation.w = 1.0;
  marker.lifetime = ros::Duration(lifetime);
  return marker;
}

}  // namespace

double automaticMarkerScale(const Scene& scene) {
  std::vector<double> diameters;
  for (const SceneBody& body : scene.bodies) {
    diameters.push_back(body.mesh->diameter());
  }
  if (diameters.empty()) {
    return kScaleShare;
  }
  const auto middle = diameters.begin() + static_cast<std::ptrdiff_t>(diameters.size() / 2);
  std::nth_element(diameters.begin(), middle, diameters.end());
  return kScaleShare * *middle;
}

std_msgs::ColorRGBA distanceColor(double distance, const MarkerStyle& style) {
  const double way = std::clamp((distance - style.near) / (style.far - style.near), 0.0, 1.0);
  std_msgs::ColorRGBA color;
  color.r = static_cast<float>(way < 0.5 ? 1.0 : 2.0 - 2.0 * way);
  color.g = static_cast<float>(way < 0.5 ? 0.45 + 0.9 * way : 0.9 - 0.3 * (way - 0.5));
  color.b = 0.05F;
  color.a = 1.0F;
  return color;
}

std::vector<visualization_msgs::Marker> nicheMarkers(const PairNiches& pair, const MarkerStyle& style,
                                                     double lifetime) {
  std::vector<visualization_msgs::Marker> markers;
  for (const DrawnNiche& niche : drawnNiches(pair)) {
    const double size = niche.nearest ? style.scale : kOtherShare * style.scale;
    std_msgs::ColorRGBA color = distanceColor(niche.distance, style);
    if (niche.nearest && pair.nearest.warning != 0) {
      color.r = 1.0F;
      color.g = color.b = 0.0F;
    }
    color.a = niche.nearest ? 1.0F : kOtherOpacity;

    visualization_msgs::Marker points = emptyMarker(pair, "points", niche.id, lifetime);
    points.type = visualization_msgs::Marker::SPHERE_LIST;
    points.scale.x = points.scale.y = points.scale.z = size;
    points.color = color;
    points.points = {niche.point_a, niche.point_b};

    visualization_msgs::Marker line = emptyMarker(pair, "line", niche.id, lifetime);
    line.type = visualization_msgs::Marker::LINE_LIST;
    line.scale.x = kLineShare * size;
    line.color = color;
    line.points = points.points;
    markers.push_back(std::move(points));
    markers.push_back(std::move(line));
    if (niche.extent > 0.0 && niche.normal.squaredNorm() > 0.0) {
      visualization_msgs::Marker rim = emptyMarker(pair, "extent", niche.id, lifetime);
      rim.type = visualization_msgs::Marker::LINE_LIST;
      rim.scale.x = kRimShare * size;
      rim.color = color;
      appendCircle(niche.point_a, niche.normal, 0.5 * niche.extent, rim.points);
      appendCircle(niche.point_b, niche.normal, 0.5 * niche.extent, rim.points);
      markers.push_back(std::move(rim));
    }
    if (!niche.nearest) {
      continue;
    }
    visualization_msgs::Marker text = emptyMarker(pair, "text", niche.id, lifetime);
    text.type = visualization_msgs::Marker::TEXT_VIEW_FACING;
    text.pose.position.x = 0.5 * (niche.point_a.x + niche.point_b.x);
    text.pose.position.y = 0.5 * (niche.point_a.y + niche.point_b.y);
    text.pose.position.z = 0.5 * (niche.point_a.z + niche.point_b.z) + kTextShare * style.scale;
    text.scale.z = kTextShare * style.scale;
    text.color = color;
    text.text = distanceText(niche.distance);
    markers.push_back(std::move(text));
  }
  return markers;
}

visualization_msgs::MarkerArray withDeletions(std::vector<visualization_msgs::Marker> markers,
                                              const std_msgs::Header& header, ShownMarkers& shown) {
  visualization_msgs::MarkerArray message;
  message.markers = std::move(markers);
  ShownMarkers now;
  for (const visualization_msgs::Marker& marker : message.markers) {
    now.emplace(marker.ns, marker.id);
  }
  for (const auto& [ns, id] : shown) {
    if (now.count({ns, id}) != 0) {
      continue;
    }
    visualization_msgs::Marker gone;
    gone.header = header;
    gone.ns = ns;
    gone.id = id;
    gone.action = visualization_msgs::Marker::DELETE;
    gone.pose.orientation.w = 1.0;
    message.markers.push_back(std::move(gone));
  }
  shown = std::move(now);
  return message;
}

}  // namespace concave_distance
