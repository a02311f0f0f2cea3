#include "constraint_conversions.h"

#include <cmath>

#include "conversions.h"

namespace concave_distance {
namespace {

static_assert(Constraint::FREE == static_cast<int>(SlotState::Free));
static_assert(Constraint::USED == static_cast<int>(SlotState::Used));
static_assert(Constraint::FREED == static_cast<int>(SlotState::Freed));

geometry_msgs::Point notComputed() {
  return toPoint(Eigen::Vector3d::Constant(kNotComputed));
}

Constraint emptyRow(SlotState state) {
  Constraint message;
  message.state = static_cast<std::uint8_t>(state);
  message.value = message.lower_bound = message.drift = kNotComputed;
  message.point_a = message.point_b = message.point_a_in_frame_a = message.point_b_in_frame_b = notComputed();
  message.normal = toVector(Eigen::Vector3d::Constant(kNotComputed));
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
  }
}

}  // namespace concave_distance
