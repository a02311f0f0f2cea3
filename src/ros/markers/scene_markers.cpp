#include "scene_markers.h"

#include <algorithm>
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

constexpr double kTintOffset = 0.1;  // distance of a red copy from the surface, over the scale
// Diameter of the largest red body over that of the region: a red floor would hide the rest.
constexpr double kLargestTint = 1.0;

void append(std::vector<Marker> from, std::vector<Marker>& to) {
  std::move(from.begin(), from.end(), std::back_inserter(to));
}

// Of a warning, what is warned of and the nearest link of the robot; of two links or two obstacles, both.
std::set<std::size_t> bodiesToTint(const Scene& scene, const PublishedPairs& pairs,
                                   const std::vector<DrawnPair>& drawn, double largest) {
  std::set<std::size_t> bodies;
  for (const DrawnPair& pair : drawn) {  // ascending by distance
    if (pair.pair->nearest.warning == 0) continue;
    const auto found = std::find_if(pairs.begin(), pairs.end(), [&](const auto& published) {
      return published->heading.pair == pair.pair->nearest.pair;
    });
    const ScenePair& ends = scene.pairs[static_cast<std::size_t>(found - pairs.begin())];
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

// As many as niches are drawn: to place a label takes long.
std::vector<Label> deepestLabels(std::vector<ContactLabel> contacts, std::uint32_t niche_count) {
  std::stable_sort(contacts.begin(), contacts.end(), [](const ContactLabel& left, const ContactLabel& right) {
    return left.depth > right.depth;
  });
  if (niche_count != 0) contacts.resize(std::min<std::size_t>(contacts.size(), niche_count));
  std::vector<Label> labels;
  labels.reserve(contacts.size());
  for (ContactLabel& contact : contacts) labels.push_back(std::move(contact.label));
  return labels;
}

bool hasExtent(const std::vector<Marker>& markers) {
  return std::any_of(markers.begin(), markers.end(), [](const Marker& marker) {
    return marker.ns.size() > 7 && marker.ns.compare(marker.ns.size() - 7, 7, "/extent") == 0;
  });
}

LegendContents contentsOf(const Scene& scene, const MarkerSelection& selection) {
  LegendContents contents;
  contents.drawn_pairs = selection.drawn.size();
  contents.pairs = selection.candidates;
  contents.dashes = std::any_of(selection.drawn.begin(), selection.drawn.end(),
                                [](const DrawnPair& pair) { return isDashed(*pair.pair); });
  contents.others = std::any_of(selection.drawn.begin(), selection.drawn.end(),
                                [](const DrawnPair& pair) { return pair.niche_count > 1; });
  for (const ScenePair& pair : scene.pairs) {
    contents.warnings = contents.warnings || pair.settings.warning_distance.has_value();
    contents.contacts = contents.contacts || pair.settings.effects.any();
  }
  return contents;
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

}  // namespace

visualization_msgs::MarkerArray SceneMarkers::draw(const Scene& scene, const MarkerStyle& style,
                                                   const PublishedPairs& pairs,
                                                   const std::vector<PairNiches>& niches,
                                                   const std::vector<PairContactState>& contacts,
                                                   const std_msgs::Header& header, double lifetime) {
  std::vector<Marker> markers;
  std::set<std::size_t> tinted;
  if (!niches.empty()) {
    const std::vector<LocatedBody> bodies = locateBodies(scene, pairs);
    layout_.update(bodies, style);
    const MarkerSelection selection = selectPairs(withKeptNiches(niches, demand_), layout_.style());
    const std::vector<DrawnPair>& drawn = selection.drawn;
    demand_.select(drawn, header.stamp);
    std::vector<ContactLabel> contact_labels;
    std::set<std::string> with_contacts;
    append(drawContacts(scene, pairs, contacts, lifetime), markers);
    for (const PairContactState& contact : contacts) {
      std::vector<ContactLabel> texts = contactLabels(contact, lifetime);
      if (!texts.empty()) with_contacts.insert(contact.pair);
      std::move(texts.begin(), texts.end(), std::back_inserter(contact_labels));
    }
    std::vector<Label> labels = deepestLabels(std::move(contact_labels), style.niche_count);
    for (const DrawnPair& pair : drawn) {
      append(nicheMarkers(pair, layout_.style(), lifetime), markers);
      if (with_contacts.count(pair.pair->nearest.pair) == 0) {
        labels.push_back(nicheLabel(*pair.pair, layout_.style(), lifetime));
      }
    }
    extents_seen_ = extents_seen_ || hasExtent(markers);
    std::vector<LabelSpace> taken;
    if (style.legend) {
      LegendContents contents = contentsOf(scene, selection);
      contents.extents = extents_seen_;
      contents.pressure_end = pressures_.end();
      std::vector<Marker> legend = legendMarkers(contents, layout_, header, lifetime);
      if (!legend.empty()) taken.push_back(spaceOfLegend(legend));
      append(std::move(legend), markers);
    }
    const double now = header.stamp.toSec();
    append(placer_.place(std::move(labels), {scene, bodies}, layout_.letterHeight(), std::move(taken), now),
           markers);
    tinted = bodiesToTint(scene, pairs, drawn, kLargestTint * layout_.region().diagonal().norm());
  }
  visualization_msgs::MarkerArray message = withDeletions(std::move(markers), header, shown_);
  append(tints_.update(scene, tinted, kTintOffset * layout_.style().scale, lifetime, header.stamp),
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
