#include "scene_markers.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include "body_markers.h"
#include "contact_markers.h"
#include "marker_parts.h"
#include "marker_selection.h"
#include "ros/time_difference.h"
#include "scene_size.h"

namespace concave_distance {
namespace {

using visualization_msgs::Marker;

constexpr double kScaleShare = 0.009;   // diameter of the nearest points over the scene's size
constexpr double kFarShare = 0.2;       // end of the colour gradient over the scene's size
constexpr double kSizeOfNothing = 1.0;  // m
constexpr double kRow = 1.2;            // from a label to the one above it, in letters
constexpr double kWidth = 8.0;          // of a label that others are kept from, likewise
constexpr std::size_t kMostStacked = 50;
constexpr double kTintOffset = 0.1;  // distance of a red copy from the surface, over the scale
constexpr double kTintLives = 3.0;   // lifetime of a red copy, in renewals
// Diameter of the largest red body over that of the region: a red floor would hide the rest.
constexpr double kLargestTint = 1.0;

void append(std::vector<Marker> from, std::vector<Marker>& to) {
  std::move(from.begin(), from.end(), std::back_inserter(to));
}

// Replaces automatic values: scale > 0, far > near.
MarkerStyle fitted(MarkerStyle style, double size) {
  if (size == 0.0) size = kSizeOfNothing;
  if (style.scale == 0.0) style.scale = kScaleShare * size;
  if (style.far == 0.0) style.far = style.near + roundedUp(kFarShare * size);
  return style;
}

// Puts labels that would cover one of a nearer pair above that one: in a column no view lets them meet.
void stack(std::vector<Marker>& labels) {
  for (std::size_t i = 0; i < std::min(labels.size(), kMostStacked); ++i) {
    geometry_msgs::Point& place = labels[i].pose.position;
    const double letters = labels[i].scale.z;
    const auto is_covered = [&](const Marker& label) {
      const geometry_msgs::Point& other = label.pose.position;
      return std::hypot(place.x - other.x, place.y - other.y) < kWidth * letters &&
             std::abs(place.z - other.z) < 0.999 * kRow * letters;
    };
    const auto end = labels.begin() + static_cast<std::ptrdiff_t>(i);
    for (auto at = labels.begin(); (at = std::find_if(labels.begin(), end, is_covered)) != end;) {
      place = at->pose.position;
      place.z += kRow * letters;
    }
  }
}

}  // namespace

visualization_msgs::MarkerArray SceneMarkers::draw(const Scene& scene, const MarkerStyle& configured,
                                                   const PublishedPairs& pairs,
                                                   const std::vector<PairNiches>& niches,
                                                   const std::vector<PairContactState>& contacts,
                                                   const std_msgs::Header& header, double lifetime) {
  std::vector<Marker> markers;
  ShownMarkers tints;
  std::unordered_map<std::string, PairNiches> drawn;
  if (niches.empty()) {
    tinted_.clear();
  } else {
    size_ = sceneSize(locatedBoxes(scene, pairs), size_);
    const MarkerStyle style = fitted(configured, size_);
    const std::vector<DrawnPair> selected = selectPairs(withStalePairs(niches), style);
    drawContacts(scene, pairs, contacts, style, markers);
    std::set<std::string> labelled;
    for (const PairContactState& pair : contacts) {
      if (!pair.contacts.empty()) labelled.insert(pair.pair);
    }
    std::vector<Marker> labels = contactLabels(contacts, style.niche_count, style.scale);
    for (const DrawnPair& pair : selected) {
      append(nicheMarkers(pair, style), markers);
      if (labelled.count(pair.pair->nearest.pair) == 0) labels.push_back(nicheLabel(*pair.pair, style));
      drawn.emplace(pair.pair->nearest.pair, *pair.pair);
    }
    stack(labels);
    append(std::move(labels), markers);
    tints = drawWarnings(scene, selected, style.scale, header.stamp, lifetime, markers);
  }
  drawn_ = std::move(drawn);
  for (Marker& marker : markers) {
    if (marker.lifetime.isZero()) marker.lifetime = ros::Duration(lifetime);
  }
  return withDeletions(std::move(markers), header, shown_, std::move(tints));
}

// A pair whose transforms have become stale has no answer any more, and is drawn as it was.
std::vector<const PairNiches*> SceneMarkers::withStalePairs(const std::vector<PairNiches>& messages) {
  std::vector<const PairNiches*> pairs;
  for (const PairNiches& message : messages) {
    pairs.push_back(&message);
    if (message.nearest.status.code != PairStatus::STALE_TRANSFORM) continue;
    const auto found = drawn_.find(message.nearest.pair);
    if (found == drawn_.end()) continue;
    found->second.header = message.header;
    found->second.nearest.status = message.nearest.status;
    pairs.back() = &found->second;
  }
  return pairs;
}

// Contacts are in the order of the pairs.
void SceneMarkers::drawContacts(const Scene& scene, const PublishedPairs& pairs,
                                const std::vector<PairContactState>& contacts, const MarkerStyle& style,
                                Markers& markers) {
  pressures_.update(largestPressure(contacts), style.pressure_scale);
  std::size_t triangles_left = kMostPressureTriangles;
  std::size_t k = 0;
  for (const PairContactState& contact : contacts) {
    while (k + 1 < pairs.size() && pairs[k]->heading.pair != contact.pair) ++k;
    DrawnPressures pressures = pressureMarkers(scene, *pairs[k]->tracked->origin, *pairs[k], contact, style,
                                               pressures_.end(), triangles_left);
    append(contactMarkers(contact, pressures.has_marker, style), markers);
    append(std::move(pressures.markers), markers);
  }
}

ShownMarkers SceneMarkers::drawWarnings(const Scene& scene, const std::vector<DrawnPair>& drawn, double scale,
                                        ros::Time now, double lifetime, Markers& markers) {
  // Also after the clock has jumped back.
  const bool renews = std::abs(secondsBetween(tints_sent_, now)) >= lifetime;
  if (renews) tints_sent_ = now;
  ShownMarkers shown;
  const std::map<std::int32_t, std::shared_ptr<const SceneBody>> before = std::exchange(tinted_, {});
  for (const std::size_t body : warnedBodies(scene, drawn, kLargestTint * size_)) {
    const auto id = static_cast<std::int32_t>(body);
    const std::shared_ptr<const SceneBody>& tinted = tinted_[id] = scene.bodies.share(body);
    shown.emplace("warning", id);
    const auto found = before.find(id);
    if (!renews && found != before.end() && found->second == tinted) continue;
    markers.push_back(warningMarker(scene, body, kTintOffset * scale));
    markers.back().lifetime = ros::Duration(kTintLives * lifetime);
  }
  return shown;
}

void SceneMarkers::forget() {
  drawn_.clear();
  shown_.clear();
  tinted_.clear();
}

}  // namespace concave_distance
