#include "message_places.h"

#include <algorithm>
#include <cmath>

namespace concave_distance {
namespace {

/// A measured speed is divided by the scale that it was made with, but by no less than this.
constexpr double kLeastScale = 0.1;

template <typename Message>
Eigen::Vector3d eigenOf(const Message& message) {
  return {message.x, message.y, message.z};
}

/// NaN where a row has another number of joints.
double product(const std::vector<double>& factors, const std::vector<double>& velocities) {
  if (factors.size() != velocities.size()) return kNotComputed;
  double sum = 0.0;
  for (std::size_t i = 0; i < factors.size(); ++i) sum += factors[i] * velocities[i];
  return sum;
}

}  // namespace

void MessagePlaces::measure(const Constraints& message) {
  meter_.begin(message.rows.size(), message.transforms.toSec());
  measured_.assign(message.rows.size(), kNotComputed);
  for (std::size_t slot = 0; slot < message.rows.size(); ++slot) {
    const Constraint& row = message.rows[slot];
    if (row.state == Constraint::USED)
      measured_[slot] = meter_.measure(slot, row.niche_id, row.age, row.value);
  }
}

void MessagePlaces::begin(const Constraints& message) {
  using Kind = GuardPlace::Kind;
  places_.clear();
  for (std::size_t slot = 0; slot < message.rows.size(); ++slot) {
    const Constraint& row = message.rows[slot];
    if (row.state != Constraint::USED) continue;
    const double measured = slot < measured_.size() ? measured_[slot] : kNotComputed;
    places_.push_back(
        {row.overlapping != 0 ? Kind::Overlaps : Kind::Row, slot, row.value, 0.0, row.drift, measured});
  }
  for (std::size_t i = 0; i < message.unlisted.size(); ++i) {
    const UnlistedPair& pair = message.unlisted[i];
    const Kind kind = pair.has_lower_bound != 0 ? Kind::Bound : Kind::Unknown;
    places_.push_back({kind, message.rows.size() + i, pair.lower_bound, 0.0, pair.drift});
  }
}

const MessagePlaces::Places& MessagePlaces::ofJoints(const Constraints& message,
                                                     const std::vector<double>& velocities) {
  begin(message);
  std::vector<double> speeds = velocities;
  for (double& speed : speeds) speed = std::abs(speed);
  const std::size_t rows = message.rows.size();
  for (GuardPlace& place : places_) {
    place.closing = place.id < rows ? -product(message.rows[place.id].jacobian, velocities)
                                    : product(message.unlisted[place.id - rows].reach, speeds);
  }
  return places_;
}

const MessagePlaces::Places& MessagePlaces::ofTwist(const Constraints& message, const GuardTwist* twist,
                                                    double scale) {
  static const Constraint kNoRow;
  static const UnlistedPair kNoPair;
  begin(message);
  const std::size_t rows = message.rows.size();
  const auto moves = [&](const std::string& frame) { return twist != nullptr && twist->moves(frame); };
  for (GuardPlace& place : places_) {
    const bool is_row = place.id < rows;
    const Constraint& row = is_row ? message.rows[place.id] : kNoRow;
    const UnlistedPair& pair = is_row ? kNoPair : message.unlisted[place.id - rows];
    const bool moves_a = moves(is_row ? row.frame_a : pair.frame_a);
    const bool moves_b = moves(is_row ? row.frame_b : pair.frame_b);
    if (moves_a && moves_b) {  // they do not move against each other by it
      place.measured = kNotComputed;
    } else if (is_row && !moves_a && !moves_b) {
      const double own = place.measured - place.drift;
      place.closing = std::isfinite(own) ? std::max(0.0, own) / std::max(scale, kLeastScale) : 0.0;
      place.measured = kNotComputed;
    } else if (is_row) {
      const Eigen::Vector3d speed = twist->twist.at(eigenOf(moves_a ? row.point_a : row.point_b));
      place.closing = (moves_a ? 1.0 : -1.0) * eigenOf(row.normal).dot(speed);
      place.drift = moves_a ? row.drift_b : row.drift_a;
    } else if (moves_a || moves_b) {
      place.closing = twist->twist.at(eigenOf(moves_a ? pair.centre_a : pair.centre_b)).norm() +
                      (moves_a ? pair.radius_a : pair.radius_b) * twist->twist.angular.norm();
    } else if (twist == nullptr || std::any_of(pair.reach.begin(), pair.reach.end(),
                                               [](double reach) { return !(reach == 0.0); })) {
      place.kind = GuardPlace::Kind::Unknown;  // an unlisted pair does not say how fast joints close it
    }
  }
  return places_;
}

}  // namespace concave_distance
