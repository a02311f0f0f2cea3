#include "niche_markers.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "marker_parts.h"
#include "ros/messages/conversions.h"

namespace concave_distance {
namespace {

constexpr double kLineShare = 0.4;   // line width over the diameter of the points
constexpr double kOtherShare = 0.5;  // size of all but the nearest niche of the nearest pair
constexpr float kOtherOpacity = 0.5F;
constexpr double kLongShare = 0.5;   // points take up at most this share of a line each ...
constexpr double kLeastShare = 0.4;  // ... but are not smaller than this share of their size
constexpr double kRimShare = 0.15;   // line width of the circles around a segment or patch
constexpr int kRimCorners = 24;
constexpr int kDashes = 5;

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

// The nearest niches; of a pair whose niches are not known, its closest points under id 0.
std::vector<Niche> drawnNiches(const PairNiches& pair, std::size_t count) {
  if (!hasMarkers(pair)) return {};
  if (!pair.niches.empty())
    return {pair.niches.begin(), pair.niches.begin() + std::min(count, pair.niches.size())};
  Niche closest;
  closest.distance = pair.nearest.distance;
  closest.point_a = pair.nearest.point_a;
  closest.point_b = pair.nearest.point_b;
  return {closest};
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

}  // namespace

std_msgs::ColorRGBA distanceColor(double distance, const MarkerStyle& style) {
  const double share = std::clamp((distance - style.near) / (style.far - style.near), 0.0, 1.0);
  // Visible on light and dark backgrounds.
  const Eigen::Vector3d near(0.95, 0.42, 0.0);
  const Eigen::Vector3d middle(0.72, 0.60, 0.0);
  const Eigen::Vector3d far(0.0, 0.55, 0.10);
  return makeColor(share < 0.5 ? near + 2.0 * share * (middle - near)
                               : middle + (2.0 * share - 1.0) * (far - middle));
}

std_msgs::ColorRGBA warningColor() {
  return makeColor({0.90, 0.0, 0.05});
}

std_msgs::ColorRGBA pairColor(const PairNiches& pair, const MarkerStyle& style) {
  if (isStale(pair)) return makeColor({0.45, 0.45, 0.45});
  return pair.nearest.warning != 0 ? warningColor() : distanceColor(pair.nearest.distance, style);
}

std::vector<visualization_msgs::Marker> nicheMarkers(const DrawnPair& drawn, const MarkerStyle& style) {
  const PairNiches& pair = *drawn.pair;
  std::vector<visualization_msgs::Marker> markers;
  bool is_nearest = true;
  for (const Niche& niche : drawnNiches(pair, drawn.niche_count)) {
    const double full = is_nearest && drawn.is_nearest ? style.scale : kOtherShare * style.scale;
    const double size = std::clamp(kLongShare * niche.distance, kLeastShare * full, full);
    std_msgs::ColorRGBA color = is_nearest ? pairColor(pair, style) : distanceColor(niche.distance, style);
    color.a = is_nearest ? 1.0F : kOtherOpacity;
    const auto add = [&](const char* kind, std::int32_t type, double width) -> visualization_msgs::Marker& {
      visualization_msgs::Marker& marker =
          markers.emplace_back(emptyMarker(pair.header, pair.nearest.pair + "/" + kind, markerId(niche.id)));
      marker.type = type;
      marker.scale.x = width;
      marker.color = color;
      return marker;
    };
    visualization_msgs::Marker& points = add("points", visualization_msgs::Marker::SPHERE_LIST, size);
    points.scale.y = points.scale.z = size;
    points.points = {niche.point_a, niche.point_b};
    visualization_msgs::Marker& line = add("line", visualization_msgs::Marker::LINE_LIST, kLineShare * size);
    line.points = {niche.point_a, niche.point_b};
    if (is_nearest && (isStale(pair) || isUncertain(pair))) dash(line.points);
    const Eigen::Vector3d normal(niche.normal.x, niche.normal.y, niche.normal.z);
    if (niche.kind != Niche::KIND_POINT && niche.extent > 0.0 && normal.squaredNorm() > 0.0) {
      visualization_msgs::Marker& rim =
          add("extent", visualization_msgs::Marker::LINE_LIST, kRimShare * full);
      appendCircle(niche.point_a, normal, 0.5 * niche.extent, rim.points);
      appendCircle(niche.point_b, normal, 0.5 * niche.extent, rim.points);
    }
    is_nearest = false;
  }
  return markers;
}

visualization_msgs::Marker nicheLabel(const PairNiches& pair, const MarkerStyle& style) {
  const Niche nearest = drawnNiches(pair, 1).front();
  const bool overlapping = pair.nearest.status.code == PairStatus::PENETRATING;
  std::string text = pair.nearest.body_a + " - " + pair.nearest.body_b + ": " +
                     (overlapping ? "overlap" : lengthText(pair.nearest.distance));
  if (isStale(pair)) text += ", stale";
  if (isUncertain(pair) && pair.nearest.has_lower_bound != 0) {
    text += ", at least " + lengthText(pair.nearest.lower_bound);
  }
  visualization_msgs::Marker label = emptyMarker(pair.header, pair.nearest.pair + "/text", 0);
  const Eigen::Vector3d middle =
      0.5 * Eigen::Vector3d(nearest.point_a.x + nearest.point_b.x, nearest.point_a.y + nearest.point_b.y,
                            nearest.point_a.z + nearest.point_b.z);
  makeLabel(text, middle, style.scale, label);
  label.color = pairColor(pair, style);
  return label;
}

visualization_msgs::MarkerArray withDeletions(std::vector<visualization_msgs::Marker> markers,
                                              const std_msgs::Header& header, ShownMarkers& shown,
                                              ShownMarkers kept) {
  visualization_msgs::MarkerArray message;
  message.markers = std::move(markers);
  ShownMarkers now = std::move(kept);
  for (const visualization_msgs::Marker& marker : message.markers) {
    now.emplace(marker.ns, marker.id);
  }
  for (const auto& [ns, id] : shown) {
    if (now.count({ns, id}) != 0) continue;
    message.markers.push_back(emptyMarker(header, ns, id));
    message.markers.back().action = visualization_msgs::Marker::DELETE;
  }
  shown = std::move(now);
  return message;
}

}  // namespace concave_distance
