#include "scene_markers.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <set>
#include <string>
#include <utility>

#include "contact_markers.h"
#include "marker_legend.h"
#include "marker_selection.h"

namespace concave_distance {
namespace {

using visualization_msgs::Marker;

constexpr std::size_t kMostLabels = 50;
constexpr double kTintOffset = 0.1;  // distance of a red copy from the surface, over the scale
// Diameter of the largest red body over that of the region: a red floor would hide the rest.
constexpr double kLargestTint = 1.0;

void append(std::vector<Marker> from, std::vector<Marker>& to) {
  std::move(from.begin(), from.end(), std::back_inserter(to));
}

// Every message, with the niches that were kept where it has none.
std::vector<const PairNiches*> withKeptNiches(const std::vector<PairNiches>& niches, MarkerDemand& demand) {
  std::vector<const PairNiches*> pairs;
  pairs.reserve(niches.size());
  for (const PairNiches& message : niches) {
    pairs.push_back(message.niches.empty() ? demand.withNiches(message) : &message);
  }
  return pairs;
}

// Those of the deepest contacts, as many as niches are drawn; then those of the pairs without contacts.
std::vector<Label> labelsOf(const std::vector<DrawnPair>& drawn,
                            const std::vector<PairContactState>& contacts, const MarkerStyle& style,
                            double lifetime) {
  std::vector<Label> labels;
  std::set<std::string> with_contacts;
  for (const PairContactState& pair : contacts) {
    std::vector<Label> of_pair = contactLabels(pair, lifetime);
    if (!of_pair.empty()) with_contacts.insert(pair.pair);
    std::move(of_pair.begin(), of_pair.end(), std::back_inserter(labels));
  }
  std::stable_sort(labels.begin(), labels.end(),
                   [](const Label& left, const Label& right) { return left.depth > right.depth; });
  if (style.niche_count != 0) labels.resize(std::min<std::size_t>(labels.size(), style.niche_count));
  for (const DrawnPair& pair : drawn) {
    if (with_contacts.count(pair.pair->nearest.pair) != 0) continue;
    labels.push_back(nicheLabel(*pair.pair, style, lifetime));
  }
  labels.resize(std::min(labels.size(), kMostLabels));
  return labels;
}

}  // namespace

visualization_msgs::MarkerArray SceneMarkers::draw(const Scene& scene, const MarkerStyle& configured,
                                                   const PublishedPairs& pairs,
                                                   const std::vector<PairNiches>& niches,
                                                   const std::vector<PairContactState>& contacts,
                                                   const std_msgs::Header& header, double lifetime) {
  std::vector<Marker> markers;
  std::set<std::size_t> warned;
  if (!niches.empty()) {
    const std::vector<LocatedBody> bodies = locateBodies(scene, pairs);
    layout_.update(bodies, configured);
    const MarkerStyle& style = layout_.style();
    const MarkerSelection selection = selectPairs(withKeptNiches(niches, demand_), style);
    demand_.select(selection.drawn, header.stamp);
    append(drawContacts(scene, pairs, contacts, lifetime), markers);
    for (const DrawnPair& pair : selection.drawn) append(nicheMarkers(pair, style, lifetime), markers);
    std::vector<Label> labels = labelsOf(selection.drawn, contacts, style, lifetime);
    append(numbers_.number(labels, scene, bodies, layout_), markers);
    std::vector<TextRow> rows;
    if (style.legend) rows = legendRows(scene, selection, style, pressures_.end(), header, lifetime);
    rows.emplace_back();  // an empty one
    for (Label& label : labels) rows.push_back({std::move(label.text)});
    append(placeRows(rows, layout_), markers);
    warned = warnedBodies(scene, selection.drawn, kLargestTint * layout_.region().diagonal().norm());
  }
  visualization_msgs::MarkerArray message = withDeletions(std::move(markers), header, shown_);
  append(tints_.update(scene, warned, kTintOffset * layout_.style().scale, lifetime, header),
         message.markers);
  return message;
}

// Contacts are in the order of the pairs.
std::vector<Marker> SceneMarkers::drawContacts(const Scene& scene, const PublishedPairs& pairs,
                                               const std::vector<PairContactState>& contacts,
                                               double lifetime) {
  std::vector<Marker> markers;
  pressures_.update(largestPressure(contacts), layout_.style().pressure_scale);
  std::size_t triangles_left = kMostPressureTriangles;
  std::size_t k = 0;
  for (const PairContactState& contact : contacts) {
    while (k + 1 < pairs.size() && pairs[k]->heading.pair != contact.pair) ++k;
    DrawnPressures pressures = pressureMarkers(scene, scene.pairs[k], *pairs[k], contact, layout_.style(),
                                               pressures_.end(), lifetime, triangles_left);
    append(contactMarkers(contact, pressures.has_marker, layout_.style(), lifetime), markers);
    append(std::move(pressures.markers), markers);
  }
  return markers;
}

void SceneMarkers::forget() {
  demand_.forget();
  shown_.clear();
  tints_.forget();
}

}  // namespace concave_distance
