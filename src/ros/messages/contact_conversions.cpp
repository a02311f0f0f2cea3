#include "contact_conversions.h"

#include <cmath>

namespace concave_distance {
namespace {

Wrench rotated(const Eigen::Matrix3d& rotation, const Wrench& wrench) {
  return {rotation * wrench.force, rotation * wrench.torque};
}

Contact toContact(const PairHeading& heading, const ContactRegion& region, const Eigen::Vector3d& origin_b) {
  const Eigen::Isometry3d& reference_from_a = heading.reference_from_a;
  const Eigen::Matrix3d rotation = reference_from_a.linear();
  const InterferenceRegion& overlap = region.overlap;
  Contact message;
  message.id = region.id;
  message.has_depth = static_cast<std::uint8_t>(!std::isnan(overlap.depth));
  message.depth = overlap.depth;
  message.contact_area = overlap.contact_area;
  message.surface_area_a = overlap.surface_area_a;
  message.surface_area_b = overlap.surface_area_b;
  message.volume = overlap.volume;
  message.centroid = toPoint(reference_from_a * overlap.centroid_in_a);
  const bool pushes = region.normal_force > 0.0;
  message.normal = toVector(rotation * (pushes ? region.force_direction_in_a : overlap.normal_in_a));
  message.point_a = toPoint(reference_from_a * overlap.point_a_in_a);
  message.point_b = toPoint(reference_from_a * overlap.point_b_in_a);
  message.loop_count = overlap.loop_count;
  message.closed = static_cast<std::uint8_t>(overlap.closed);
  message.touching = static_cast<std::uint8_t>(overlap.touching);
  message.normal_is_fallback = static_cast<std::uint8_t>(overlap.normal_is_fallback);
  message.a_swallowed = static_cast<std::uint8_t>(overlap.a_swallowed);
  message.b_swallowed = static_cast<std::uint8_t>(overlap.b_swallowed);
  message.consistent = static_cast<std::uint8_t>(overlap.consistent);

  message.has_force = static_cast<std::uint8_t>(!std::isnan(region.normal_force));
  message.force_point = toPoint(reference_from_a * region.point_in_a);
  message.depth_rate = region.depth_rate;
  message.sliding_velocity = toVector(rotation * region.sliding_in_a);
  message.normal_force = region.normal_force;
  message.largest_pressure = region.largest_pressure;
  message.has_friction = static_cast<std::uint8_t>(region.friction_on_b_in_a.allFinite());
  message.friction = toVector(rotation * region.friction_on_b_in_a);
  message.wrench = toWrench(rotated(rotation, movedTo(origin_b, region.on_b_in_a)));
  return message;
}

}  // namespace

PairContactState emptyContacts(const PairHeading& heading, const PairStatus& status) {
  auto message = headedMessage<PairContactState>(heading, status);
  const Eigen::Vector3d not_computed = Eigen::Vector3d::Constant(kNotComputed);
  message.wrench_point = toPoint(not_computed);
  message.wrench = toWrench({not_computed, not_computed});
  return message;
}

PairContactState toContacts(const PairHeading& heading, const PairStatus& status,
                            const PairContacts& contacts, const Eigen::Isometry3d& a_from_b) {
  PairContactState message = emptyContacts(heading, status);
  const Eigen::Vector3d origin_b = a_from_b.translation();
  message.possible = static_cast<std::uint8_t>(contacts.possible);
  if (contacts.cut) {
    message.status.code = PairStatus::BUDGET_EXHAUSTED;
    message.status.message = "no time or memory was left to find the regions of contact: raise time_budget";
  }
  message.a_inside_b = static_cast<std::uint8_t>(contacts.a_inside_b);
  message.b_inside_a = static_cast<std::uint8_t>(contacts.b_inside_a);
  message.contacts.reserve(contacts.regions.size());
  for (const ContactRegion& region : contacts.regions) {
    message.contacts.push_back(toContact(heading, region, origin_b));
  }
  message.has_wrench = static_cast<std::uint8_t>(contacts.on_b_in_a.force.allFinite());
  message.wrench_point = toPoint(heading.reference_from_a * origin_b);
  message.wrench =
      toWrench(rotated(heading.reference_from_a.linear(), movedTo(origin_b, contacts.on_b_in_a)));
  return message;
}

}  // namespace concave_distance
