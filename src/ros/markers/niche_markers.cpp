#include "niche_markers.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ros/messages/conversions.h"

namespace concave_distance {
namespace {

constexpr double kLineShare = 0.4;   // line width over the diameter of the points
constexpr double kOtherShare = 0.5;  // size of the niches that are not the nearest
constexpr float kOtherOpacity = 0.5F;
constexpr double kLongShare = 0.5;   // points take up at most this share of a line each ...
constexpr double kLeastShare = 0.4;  // ... but are not smaller than this share of their size
constexpr double kRimShare = 0.15;   // line width of the circles around a segment or patch
constexpr int kRimCorners = 24;
constexpr int kDashes = 5;

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

bool isStale(const PairNiches& pair) {
  return pair.nearest.status.code == PairStatus::STALE_TRANSFORM;
}

// Whether the true distance may be smaller than the one reported.
bool isUncertain(const PairNiches& pair) {
  const auto code = pair.nearest.status.code;
  return code == PairStatus::BUDGET_EXHAUSTED || code == PairStatus::MEMORY_EXHAUSTED ||
         code == PairStatus::WITHIN_TOLERANCE;
}

// Replaces a line by the dashes of it.
void dash(std::vector<geometry_msgs::Point>& line) {
  const Eigen::Vector3d from(line[0].x, line[0].y, line[0].z);
  const Eigen::Vector3d along = Eigen::Vector3d(line[1].x, line[1].y, line[1].z) - from;
  line.clear();
  for (int end = 0; end < 2 * kDashes; ++end) {  // a dash, a gap of the same length, and so on
    line.push_back(toPoint(from + end / (2.0 * kDashes - 1.0) * along));
  }
}

std::vector<DrawnNiche> drawnNiches(const PairNiches& pair, std::size_t count) {
  std::vector<DrawnNiche> drawn;
  if (!hasMarkers(pair)) {
    return drawn;
  }
  for (std::size_t k = 0; k < std::min(count, pair.niches.size()); ++k) {
    const Niche& niche = pair.niches[k];
    drawn.push_back({markerId(niche.id), niche.distance, niche.point_a, niche.point_b, drawn.empty(),
                     niche.kind == Niche::KIND_POINT ? 0.0 : niche.extent,
                     Eigen::Vector3d(niche.normal.x, niche.normal.y, niche.normal.z)});
  }
  if (pair.niches.empty()) {
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

bool isDashed(const PairNiches& pair) {
  return isStale(pair) || isUncertain(pair);
}

std_msgs::ColorRGBA distanceColor(double distance, const MarkerStyle& style) {
  const double share = std::clamp((distance - style.near) / (style.far - style.near), 0.0, 1.0);
  std_msgs::ColorRGBA color;
  // Visible on light and dark backgrounds.
  const Eigen::Vector3d kNear(0.95, 0.42, 0.0);
  const Eigen::Vector3d kMiddle(0.72, 0.60, 0.0);
  const Eigen::Vector3d kFar(0.0, 0.55, 0.10);
  const Eigen::Vector3d mixed = share < 0.5
                                    ? Eigen::Vector3d(kNear + 2.0 * share * (kMiddle - kNear))
                                    : Eigen::Vector3d(kMiddle + (2.0 * share - 1.0) * (kFar - kMiddle));
  color.r = static_cast<float>(mixed.x());
  color.g = static_cast<float>(mixed.y());
  color.b = static_cast<float>(mixed.z());
  color.a = 1.0F;
  return color;
}

std_msgs::ColorRGBA warningColor() {
  std_msgs::ColorRGBA color;
  color.r = 0.90F;
  color.g = 0.0F;
  color.b = 0.05F;
  color.a = 1.0F;
  return color;
}

std_msgs::ColorRGBA greyColor() {
  std_msgs::ColorRGBA color;
  color.r = color.g = color.b = 0.45F;
  color.a = 1.0F;
  return color;
}

std_msgs::ColorRGBA pairColor(const PairNiches& pair, const MarkerStyle& style) {
  if (isStale(pair)) return greyColor();
  return pair.nearest.warning != 0 ? warningColor() : distanceColor(pair.nearest.distance, style);
}

std::vector<visualization_msgs::Marker> nicheMarkers(const DrawnPair& drawn, const MarkerStyle& style,
                                                     double lifetime) {
  const PairNiches& pair = *drawn.pair;
  std::vector<visualization_msgs::Marker> markers;
  for (const DrawnNiche& niche : drawnNiches(pair, drawn.niche_count)) {
    const double full = niche.nearest ? style.scale : kOtherShare * style.scale;
    const double size = std::clamp(kLongShare * niche.distance, kLeastShare * full, full);
    std_msgs::ColorRGBA color = niche.nearest ? pairColor(pair, style) : distanceColor(niche.distance, style);
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
    if (niche.nearest && isDashed(pair)) dash(line.points);
    markers.push_back(std::move(points));
    markers.push_back(std::move(line));
    if (niche.extent > 0.0 && niche.normal.squaredNorm() > 0.0) {
      visualization_msgs::Marker rim = emptyMarker(pair, "extent", niche.id, lifetime);
      rim.type = visualization_msgs::Marker::LINE_LIST;
      rim.scale.x = kRimShare * full;
      rim.color = color;
      appendCircle(niche.point_a, niche.normal, 0.5 * niche.extent, rim.points);
      appendCircle(niche.point_b, niche.normal, 0.5 * niche.extent, rim.points);
      markers.push_back(std::move(rim));
    }
  }
  return markers;
}

Label nicheLabel(const PairNiches& pair, const MarkerStyle& style, double lifetime) {
  const bool known = !pair.niches.empty();
  const std::int32_t id = known ? markerId(pair.niches.front().id) : 0;
  const geometry_msgs::Point& a = known ? pair.niches.front().point_a : pair.nearest.point_a;
  const geometry_msgs::Point& b = known ? pair.niches.front().point_b : pair.nearest.point_b;
  Label label;
  label.from = {a.x, a.y, a.z};
  label.to = {b.x, b.y, b.z};
  label.marker = emptyMarker(pair, "text", id, lifetime);
  label.marker.type = visualization_msgs::Marker::TEXT_VIEW_FACING;
  label.marker.color = pairColor(pair, style);
  const bool overlapping = pair.nearest.status.code == PairStatus::PENETRATING;
  label.marker.text = pair.nearest.body_a + " - " + pair.nearest.body_b + ": " +
                      (overlapping ? "overlap" : lengthText(pair.nearest.distance));
  if (isStale(pair)) label.marker.text += ", stale";
  if (isUncertain(pair) && pair.nearest.has_lower_bound != 0) {
    label.marker.text += ", at least " + lengthText(pair.nearest.lower_bound);
  }
  return label;
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
