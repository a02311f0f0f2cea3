#include "contact_markers.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "marker_parts.h"
#include "ros/messages/conversions.h"

namespace concave_distance {
namespace {

using visualization_msgs::Marker;

constexpr double kDiscHeight = 0.06;  // over the scale of the markers
constexpr double kLineWidth = 0.12;
constexpr double kShaftWidth = 0.22;
constexpr double kHeadWidth = 0.55;
constexpr double kHeadLength = 0.6;
constexpr double kHeadShare = 0.4;  // of a short arrow's length

Eigen::Vector3d toEigen(const geometry_msgs::Point& point) {
  return {point.x, point.y, point.z};
}
Eigen::Vector3d toEigen(const geometry_msgs::Vector3& vector) {
  return {vector.x, vector.y, vector.z};
}

std_msgs::ColorRGBA contactColor() {
  return makeColor({0.90, 0.20, 0.75});
}

// A disc as large as the contact's area, across the normal.
void drawArea(const Contact& contact, double scale, Marker& marker) {
  marker.type = Marker::CYLINDER;
  marker.pose.position = contact.centroid;
  marker.pose.orientation =
      toQuaternion(Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), toEigen(contact.normal)));
  marker.scale.x = marker.scale.y = 2.0 * std::sqrt(contact.contact_area / M_PI);
  marker.scale.z = kDiscHeight * scale;
  marker.color = contactColor();
  marker.color.a = 0.5F;
}

// An arrow from the point where the force acts; a short one keeps its shape.
void drawForce(const geometry_msgs::Point& from, const Eigen::Vector3d& arrow, double scale, Marker& marker) {
  marker.type = Marker::ARROW;
  marker.points = {from, toPoint(toEigen(from) + arrow)};
  const double head = std::min(kHeadLength * scale, kHeadShare * arrow.norm());
  const double thinness = head / (kHeadLength * scale);
  marker.scale.x = kShaftWidth * scale * thinness;
  marker.scale.y = kHeadWidth * scale * thinness;
  marker.scale.z = head;
}

std::string contactText(const Contact& contact) {
  std::string text;
  if (contact.has_depth != 0) text = lengthText(contact.depth) + " deep";
  if (contact.has_force != 0) {
    const double newtons = toEigen(contact.wrench.force).norm();
    text += (text.empty() ? "" : ", ") + forceText(newtons);
  }
  if (contact.largest_pressure > 0.0) text += ", up to " + pressureText(contact.largest_pressure);
  return text.empty() ? "contact" : text;
}

}  // namespace

Marker emptyContactMarker(const PairContactState& pair, const char* kind, std::size_t index) {
  const std::uint64_t id = pair.contacts[index].id;
  return emptyMarker(
      pair.header, pair.pair + "/" + kind,
      id == 0 ? -1 - static_cast<std::int32_t>(index) : static_cast<std::int32_t>(id & 0x7fffffffU));
}

std::vector<Marker> contactMarkers(const PairContactState& pair, const std::vector<bool>& without_disc,
                                   const MarkerStyle& style) {
  std::vector<Marker> markers;
  for (std::size_t k = 0; k < pair.contacts.size(); ++k) {
    const Contact& contact = pair.contacts[k];
    const auto add = [&](const char* kind) -> Marker& {
      return markers.emplace_back(emptyContactMarker(pair, kind, k));
    };
    const bool has_disc = !without_disc[k] && toEigen(contact.normal).allFinite();
    if (contact.contact_area > 0.0 && has_disc) drawArea(contact, style.scale, add("contact_area"));
    if (contact.depth > 0.0) {
      Marker& line = add("contact_depth");
      line.type = Marker::LINE_LIST;
      line.scale.x = kLineWidth * style.scale;
      line.color = makeColor({0.35, 0.0, 0.35});
      line.points = {contact.point_a, contact.point_b};
    }
    if (contact.has_force != 0 && contact.normal_force > 0.0) {
      Marker& arrow = add("normal_force");
      arrow.color = makeColor({0.85, 0.05, 0.10});
      drawForce(contact.force_point, contact.normal_force / style.force_scale * toEigen(contact.normal),
                style.scale, arrow);
    }
    if (contact.has_friction != 0 && toEigen(contact.friction).norm() > 0.0) {
      Marker& arrow = add("friction");
      arrow.color = makeColor({0.10, 0.40, 0.95});
      drawForce(contact.force_point, toEigen(contact.friction) / style.force_scale, style.scale, arrow);
    }
  }
  return markers;
}

std::vector<Marker> contactLabels(const std::vector<PairContactState>& pairs, std::size_t most,
                                  double scale) {
  std::vector<std::pair<double, Marker>> labels;
  for (const PairContactState& pair : pairs) {
    for (std::size_t k = 0; k < pair.contacts.size(); ++k) {
      const Contact& contact = pair.contacts[k];
      if (!toEigen(contact.centroid).allFinite()) continue;
      Marker label = emptyContactMarker(pair, "contact_text", k);
      label.color = contactColor();
      makeLabel(pair.body_a + " - " + pair.body_b + ": " + contactText(contact), toEigen(contact.centroid),
                scale, label);
      labels.emplace_back(contact.has_depth != 0 ? contact.depth : 0.0, std::move(label));
    }
  }
  std::stable_sort(labels.begin(), labels.end(),
                   [](const auto& left, const auto& right) { return left.first > right.first; });
  if (most > 0 && labels.size() > most) labels.resize(most);
  std::vector<Marker> markers;
  for (auto& label : labels) markers.push_back(std::move(label.second));
  return markers;
}

}  // namespace concave_distance
