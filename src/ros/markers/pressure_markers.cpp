#include "pressure_markers.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "body_markers.h"
#include "contact/pressure_triangles.h"
#include "contact_markers.h"
#include "marker_parts.h"
#include "ros/messages/conversions.h"

namespace concave_distance {
namespace {

using visualization_msgs::Marker;

constexpr double kSurfaceLift = 0.03;  // over the scale of the markers
constexpr double kKeptShare = 0.25;    // of its end: a scale is kept while the largest pressure is above

void drawTriangles(const std::vector<PressureTriangle>& triangles, double scale, Marker& marker) {
  marker.type = Marker::TRIANGLE_LIST;
  marker.scale.x = marker.scale.y = marker.scale.z = 1.0;
  marker.color.a = 1.0F;
  marker.points.reserve(3 * triangles.size());
  marker.colors.reserve(3 * triangles.size());
  for (const PressureTriangle& triangle : triangles) {
    for (const PressurePoint& corner : triangle) {
      marker.points.push_back(toPoint(corner.point_in_a));
      marker.colors.push_back(pressureColor(corner.pressure, scale));
    }
  }
}

/// The region's surface of the body that is not looked through, or of the other one.
std::vector<PressureTriangle> trianglesOf(const TrackedPair& pair, const ContactRegion& region,
                                          const PressureField& field, bool of_b_first, double lift,
                                          std::size_t most) {
  const OverlapFacet* facets = pair.effects.effects()->surfaces().facets.data() + region.overlap.first_facet;
  const Eigen::Isometry3d& a_from_b = pair.input.a_from_b;
  std::vector<PressureTriangle> triangles;
  for (const bool of_b : {of_b_first, !of_b_first}) {
    const PressedSurface surface{facets,
                                 facets + region.overlap.facet_count,
                                 of_b,
                                 of_b ? *pair.body_a->mesh : *pair.body_b->mesh,
                                 of_b ? Eigen::Isometry3d::Identity() : a_from_b.inverse(Eigen::Isometry),
                                 field};
    // The other body's lies within the one that is drawn: out of that.
    triangles = pressureTriangles(surface, of_b == of_b_first ? lift : -lift, most);
    if (!triangles.empty()) break;
  }
  return triangles;
}

}  // namespace

std_msgs::ColorRGBA pressureColor(double pressure, double end) {
  // Its brightness grows all along, so that it can be read without telling red from green.
  static const std::array<Eigen::Vector3d, 4> kColors = {
      Eigen::Vector3d(0.05, 0.03, 0.53), Eigen::Vector3d(0.49, 0.01, 0.66), Eigen::Vector3d(0.84, 0.24, 0.35),
      Eigen::Vector3d(0.98, 0.62, 0.15)};
  const double place = 3.0 * std::clamp(pressure / end, 0.0, 1.0);
  const auto first = static_cast<std::size_t>(std::min(2.0, std::floor(place)));
  const double share = place - static_cast<double>(first);
  return makeColor((1.0 - share) * kColors[first] + share * kColors[first + 1]);
}

void PressureScale::update(double largest, double fixed) {
  if (!(largest > 0.0)) return;
  if (fixed > 0.0) {
    end_ = fixed;
  } else if (largest > end_ || largest < kKeptShare * end_) {
    end_ = roundedUp(largest);
  }
}

DrawnPressures pressureMarkers(const Scene& scene, const ScenePair& scene_pair, const PublishedPair& pair,
                               const PairContactState& contacts, const MarkerStyle& style, double scale,
                               std::size_t& triangles_left) {
  DrawnPressures drawn;
  drawn.has_marker.assign(contacts.contacts.size(), false);
  const TrackedPair& tracked = *pair.tracked;
  const PairEffects* effects = tracked.effects.effects();
  if (effects == nullptr || !tracked.solved()) return drawn;
  const std::vector<ContactRegion>& regions = tracked.effects.contacts()->regions;
  const bool of_b = seenThrough(scene, scene_pair) == scene_pair.body_a;
  for (std::size_t k = 0; k < std::min(regions.size(), contacts.contacts.size()); ++k) {
    const PressureField* field = effects->pressure(k);
    if (field == nullptr || !(regions[k].largest_pressure > 0.0)) continue;
    const std::vector<PressureTriangle> triangles =
        trianglesOf(tracked, regions[k], *field, of_b, kSurfaceLift * style.scale, triangles_left);
    if (triangles.empty()) continue;
    triangles_left -= triangles.size();
    drawn.has_marker[k] = true;
    Marker& marker = drawn.markers.emplace_back(emptyContactMarker(contacts, "pressure", k));
    marker.pose.position = toPoint(pair.heading.reference_from_a.translation());
    marker.pose.orientation = toQuaternion(Eigen::Quaterniond(pair.heading.reference_from_a.linear()));
    drawTriangles(triangles, scale, marker);
  }
  return drawn;
}

double largestPressure(const std::vector<PairContactState>& contacts) {
  double largest = 0.0;
  for (const PairContactState& pair : contacts) {
    for (const Contact& contact : pair.contacts) {
      if (contact.largest_pressure > largest) largest = contact.largest_pressure;
    }
  }
  return largest;
}

}  // namespace concave_distance
