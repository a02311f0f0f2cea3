#include "scene_markers.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include "body_markers.h"
#include "contact_markers.h"
#include "marker_list.h"
#include "marker_selection.h"
#include "ros/time_difference.h"

namespace concave_distance {
namespace {

using visualization_msgs::Marker;

constexpr std::size_t kRows = 8;         // of pairs, unless more are asked for
constexpr std::size_t kMostLabels = 50;  // a request for more gets no more
constexpr double kTintOffset = 0.1;      // distance of a red copy from the surface, over the scale
constexpr double kTintLives = 3.0;       // lifetime of a red copy, in renewals
// Diameter of the largest red body over that of the region: a red floor would hide the rest.
constexpr double kLargestTint = 1.0;

void append(std::vector<Marker> from, std::vector<Marker>& to) {
  std::move(from.begin(), from.end(), std::back_inserter(to));
}

// Keeps the first labels. @return how many it drops
std::size_t cut(std::vector<Label>& labels, std::size_t count) {
  const std::size_t dropped = labels.size() - std::min(labels.size(), count);
  labels.resize(labels.size() - dropped);
  return dropped;
}

// Labels of the deepest contacts, as many as niches are drawn; then those of the nearest pairs without
// contacts.
// @param left_out number of those that the list has no room for
std::vector<Label> labelsOf(const std::vector<DrawnPair>& drawn,
                            const std::vector<PairContactState>& contacts, const MarkerStyle& style,
                            std::size_t& left_out) {
  std::vector<Label> labels;
  std::set<std::string> with_contacts;
  for (const PairContactState& pair : contacts) {
    std::vector<Label> of_pair = contactLabels(pair);
    if (!of_pair.empty()) with_contacts.insert(pair.pair);
    std::move(of_pair.begin(), of_pair.end(), std::back_inserter(labels));
  }
  std::stable_sort(labels.begin(), labels.end(),
                   [](const Label& left, const Label& right) { return left.depth > right.depth; });
  left_out = cut(labels, style.niche_count == 0 ? kMostLabels : style.niche_count);
  const std::size_t room =
      style.pair_count == 0 ? kMostLabels : std::max<std::size_t>(kRows, style.pair_count);
  const std::size_t most = std::min(kMostLabels, labels.size() + room);
  for (const DrawnPair& pair : drawn) {
    if (with_contacts.count(pair.pair->nearest.pair) != 0) continue;
    labels.push_back(nicheLabel(*pair.pair, style));
  }
  left_out += cut(labels, most);
  return labels;
}

}  // namespace

visualization_msgs::MarkerArray SceneMarkers::draw(const Scene& scene, const MarkerStyle& configured,
                                                   const PublishedPairs& pairs,
                                                   const std::vector<PairNiches>& niches,
                                                   const std::vector<PairContactState>& contacts,
                                                   const std_msgs::Header& header, double lifetime) {
  std::vector<Marker> markers;
  ShownMarkers tints;
  if (niches.empty()) {
    tinted_.clear();
  } else {
    const std::vector<LocatedBody> bodies = locateBodies(scene, pairs);
    layout_ = layOut(bodies, configured, layout_.region);
    const MarkerStyle& style = layout_.style;
    const MarkerSelection selection = selectPairs(demand_.withKeptNiches(niches), style);
    demand_.select(selection.drawn, header.stamp);
    drawContacts(scene, pairs, contacts, markers);
    for (const DrawnPair& pair : selection.drawn) append(nicheMarkers(pair, style), markers);
    std::size_t left_out = 0;
    std::vector<Label> labels = labelsOf(selection.drawn, contacts, style, left_out);
    append(numbers_.number(labels, scene, bodies, layout_.letter_height), markers);
    std::vector<TextRow> rows;
    if (style.legend) rows = legendRows(scene, selection, style, pressures_.end(), header);
    rows.emplace_back();  // an empty one
    for (Label& label : labels) rows.push_back({std::move(label.text)});
    if (left_out > 0) {
      const std::string words = "and " + std::to_string(left_out) + " more";
      rows.push_back({textMarker(header, "more", 0, words, greyColor())});
    }
    append(placeRows(rows, layout_), markers);
    tints = drawWarnings(scene, selection.drawn, header.stamp, lifetime, markers);
  }
  for (Marker& marker : markers) {
    if (marker.lifetime.isZero()) marker.lifetime = ros::Duration(lifetime);
  }
  return withDeletions(std::move(markers), header, shown_, std::move(tints));
}

// Contacts are in the order of the pairs.
void SceneMarkers::drawContacts(const Scene& scene, const PublishedPairs& pairs,
                                const std::vector<PairContactState>& contacts, Markers& markers) {
  pressures_.update(largestPressure(contacts), layout_.style.pressure_scale);
  std::size_t triangles_left = kMostPressureTriangles;
  std::size_t k = 0;
  for (const PairContactState& contact : contacts) {
    while (k + 1 < pairs.size() && pairs[k]->heading.pair != contact.pair) ++k;
    DrawnPressures pressures = pressureMarkers(scene, *pairs[k]->tracked->origin, *pairs[k], contact,
                                               layout_.style, pressures_.end(), triangles_left);
    append(contactMarkers(contact, pressures.has_marker, layout_.style), markers);
    append(std::move(pressures.markers), markers);
  }
}

ShownMarkers SceneMarkers::drawWarnings(const Scene& scene, const std::vector<DrawnPair>& drawn,
                                        ros::Time now, double lifetime, Markers& markers) {
  // Also after the clock has jumped back.
  const bool renews = std::abs(secondsBetween(tints_sent_, now)) >= lifetime;
  if (renews) tints_sent_ = now;
  ShownMarkers shown;
  const std::map<std::int32_t, std::shared_ptr<const SceneBody>> before = std::exchange(tinted_, {});
  for (const std::size_t body : warnedBodies(scene, drawn, kLargestTint * layout_.region.diagonal().norm())) {
    const auto id = static_cast<std::int32_t>(body);
    const std::shared_ptr<const SceneBody>& tinted = tinted_[id] = scene.bodies.share(body);
    shown.emplace("warning", id);
    const auto found = before.find(id);
    if (!renews && found != before.end() && found->second == tinted) continue;
    markers.push_back(warningMarker(scene, body, kTintOffset * layout_.style.scale));
    markers.back().lifetime = ros::Duration(kTintLives * lifetime);
  }
  return shown;
}

void SceneMarkers::forget() {
  demand_.forget();
  shown_.clear();
  tinted_.clear();
}

}  // namespace concave_distance
