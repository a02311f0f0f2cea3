#include "constraint_conversions.h"

#include <cmath>

#include "conversions.h"

namespace concave_distance {
namespace {

static_assert(Constraint::FREE == static_cast<int>(SlotState::Free));
static_assert(Constraint::USED == static_cast<int>(SlotState::Used));
static_assert(Constraint::FREED == static_cast<int>(SlotState::Freed));

static_assert(UnlistedPair::NO_POSE == static_cast<int>(UnlistedReason::NoPose));
static_assert(UnlistedPair::NO_SLOT == static_cast<int>(UnlistedReason::NoSlot));

geometry_msgs::Point notComputed() {
  return toPoint(Eigen::Vector3d::Constant(kNotComputed));
}

Constraint emptyRow(SlotState state) {
  Constraint message;
  message.state = static_cast<std::uint8_t>(state);
  message.value = message.lower_bound = kNotComputed;
  message.drift = message.drift_a = message.drift_b = kNotComputed;
  message.point_a = message.point_b = message.point_a_in_frame_a = message.point_b_in_frame_b = notComputed();
  message.normal = toVector(Eigen::Vector3d::Constant(kNotComputed));
  return message;
}

UnlistedPair toUnlisted(const ConstraintRows& rows, std::size_t index) {
  const UnlistedPlaces& places = rows.unlisted()[index];
  UnlistedPair message;
  message.reason = static_cast<std::uint8_t>(places.reason);
  message.has_lower_bound = static_cast<std::uint8_t>(!std::isnan(places.lower_bound));
  message.lower_bound = places.lower_bound;
  message.drift = places.drift;
  message.centre_a = toPoint(places.ball_a.centre);
  message.centre_b = toPoint(places.ball_b.centre);
  message.radius_a = places.ball_a.radius;
  message.radius_b = places.ball_b.radius;
  if (places.pair == nullptr) {
    message.body_a = rows.joints().nameOf(places.body);
    return message;
  }
  message.pair = places.pair->origin->name;
  message.body_a = places.pair->body_a->name;
  message.body_b = places.pair->body_b->name;
  message.frame_a = places.pair->body_a->frame;
  message.frame_b = places.pair->body_b->frame;
  if (message.has_lower_bound != 0) {
    const auto reach = rows.reach().row(static_cast<Eigen::Index>(index));
    message.reach.assign(reach.data(), reach.data() + reach.size());
  }
  return message;
}

}  // namespace

void fillConstraints(const ConstraintRows& rows, Constraints& message) {
  message.joints = rows.joints().velocityNames();
  message.rows_without_slot = static_cast<std::uint32_t>(rows.overflow());
  message.rows.reserve(rows.rows().size());
  for (std::size_t slot = 0; slot < rows.rows().size(); ++slot) {
    const ConstraintRow& row = rows.rows()[slot];
    Constraint& sent = message.rows.emplace_back(emptyRow(row.state));
    if (row.state != SlotState::Used) continue;
    sent.pair = row.pair->origin->name;
    sent.body_a = row.pair->body_a->name;
    sent.body_b = row.pair->body_b->name;
    sent.niche_id = row.niche_id;
    sent.age = row.age;
    sent.value = row.value;
    sent.overlapping = static_cast<std::uint8_t>(row.is_overlapping);
    sent.has_lower_bound = static_cast<std::uint8_t>(!std::isnan(row.lower_bound));
    sent.lower_bound = row.lower_bound;
    sent.normal = toVector(row.normal);
    sent.point_a = toPoint(row.point_a);
    sent.point_b = toPoint(row.point_b);
    sent.frame_a = row.pair->body_a->frame;
    sent.frame_b = row.pair->body_b->frame;
    sent.point_a_in_frame_a = toPoint(row.point_a_in_frame);
    sent.point_b_in_frame_b = toPoint(row.point_b_in_frame);
    const auto gradient = rows.jacobian().row(static_cast<Eigen::Index>(slot));
    sent.jacobian.assign(gradient.data(), gradient.data() + gradient.size());
    sent.has_drift = static_cast<std::uint8_t>(!std::isnan(row.drift));
    sent.drift = row.drift;
    sent.drift_a = row.drift_a;
    sent.drift_b = row.drift_b;
  }
  for (std::size_t i = 0; i < rows.unlisted().size(); ++i) message.unlisted.push_back(toUnlisted(rows, i));
}

}  // namespace concave_distance
