#include "message_places.h"

#include <algorithm>
#include <cmath>

namespace concave_distance {
namespace {

/// A measured speed is divided by the scale that it was made with, but by no less than this.
constexpr double kLeastScale = 0.1;

Eigen::Vector3d eigenOf(const geometry_msgs::Point& point) {
  return {point.x, point.y, point.z};
}
Eigen::Vector3d eigenOf(const geometry_msgs::Vector3& vector) {
  return {vector.x, vector.y, vector.z};
}

/// The speed of what the command moves, by how fast the row came nearer in all.
double unscaled(const GuardPlace& place, double scale) {
  const double own = place.measured - place.drift;
  return std::isfinite(own) ? std::max(0.0, own) / std::max(scale, kLeastScale) : 0.0;
}

double largestSpeed(const RelativeTwist& twist, const geometry_msgs::Point& centre, double radius) {
  return twist.at(eigenOf(centre)).norm() + radius * twist.angular.norm();
}

bool isReached(const UnlistedPair& pair) {
  return std::any_of(pair.reach.begin(), pair.reach.end(), [](double reach) { return !(reach == 0.0); });
}

}  // namespace

void MessagePlaces::measure(const Constraints& message) {
  meter_.begin(message.rows.size(), message.transforms.toSec());
  measured_.assign(message.rows.size(), kNotComputed);
  for (std::size_t slot = 0; slot < message.rows.size(); ++slot) {
    const Constraint& row = message.rows[slot];
    if (row.state != Constraint::USED) continue;
    measured_[slot] = meter_.measure(slot, row.niche_id, row.age, row.value);
  }
}

void MessagePlaces::reset() {
  meter_.reset();
  measured_.clear();
}

GuardPlace MessagePlaces::rowOf(const Constraints& message, std::size_t slot) const {
  const Constraint& row = message.rows[slot];
  GuardPlace place;
  place.id = slot;
  if (row.overlapping != 0) place.kind = GuardPlace::Kind::Overlaps;
  place.value = row.value;
  place.drift = row.drift;
  if (slot < measured_.size()) place.measured = measured_[slot];
  return place;
}

GuardPlace MessagePlaces::unlistedOf(const Constraints& message, std::size_t index) {
  const UnlistedPair& pair = message.unlisted[index];
  GuardPlace place;
  place.id = message.rows.size() + index;
  place.kind = pair.has_lower_bound != 0 ? GuardPlace::Kind::Bound : GuardPlace::Kind::Unknown;
  place.value = pair.lower_bound;
  place.drift = pair.drift;
  return place;
}

template <typename Complete, typename CompleteUnlisted>
const MessagePlaces::Places& MessagePlaces::make(const Constraints& message, Complete complete,
                                                 CompleteUnlisted complete_unlisted) {
  places_.clear();
  for (std::size_t slot = 0; slot < message.rows.size(); ++slot) {
    if (message.rows[slot].state != Constraint::USED) continue;
    places_.push_back(rowOf(message, slot));
    complete(message.rows[slot], places_.back());
  }
  for (std::size_t i = 0; i < message.unlisted.size(); ++i) {
    places_.push_back(unlistedOf(message, i));
    if (places_.back().kind == GuardPlace::Kind::Bound)
      complete_unlisted(message.unlisted[i], places_.back());
  }
  return places_;
}

const MessagePlaces::Places& MessagePlaces::ofJoints(const Constraints& message,
                                                     const std::vector<double>& velocities) {
  const auto sum = [&](const std::vector<double>& factors, auto term) {
    if (factors.size() != velocities.size()) return kNotComputed;
    double total = 0.0;
    for (std::size_t i = 0; i < factors.size(); ++i) total += term(factors[i], velocities[i]);
    return total;
  };
  return make(
      message,
      [&](const Constraint& row, GuardPlace& place) {
        place.closing = -sum(row.jacobian, [](double rate, double velocity) { return rate * velocity; });
      },
      [&](const UnlistedPair& pair, GuardPlace& place) {
        place.closing =
            sum(pair.reach, [](double reach, double velocity) { return reach * std::abs(velocity); });
      });
}

const MessagePlaces::Places& MessagePlaces::ofTwist(const Constraints& message, const GuardTwist& twist,
                                                    double scale) {
  return make(
      message,
      [&](const Constraint& row, GuardPlace& place) {
        const bool moves_a = twist.moves(row.frame_a);
        const bool moves_b = twist.moves(row.frame_b);
        if (moves_a == moves_b) {
          // Both hang on the frame, and do not move against each other by it; or neither does.
          place.closing = moves_a ? 0.0 : unscaled(place, scale);
          place.measured = kNotComputed;
          return;
        }
        const Eigen::Vector3d speed = twist.twist.at(eigenOf(moves_a ? row.point_a : row.point_b));
        place.closing = (moves_a ? 1.0 : -1.0) * eigenOf(row.normal).dot(speed);
        place.drift = moves_a ? row.drift_b : row.drift_a;
      },
      [&](const UnlistedPair& pair, GuardPlace& place) {
        const bool moves_a = twist.moves(pair.frame_a);
        const bool moves_b = twist.moves(pair.frame_b);
        // The twist moves neither body, but joints do: an unlisted pair does not say how fast they close.
        if (!moves_a && !moves_b && isReached(pair)) place.kind = GuardPlace::Kind::Unknown;
        if (moves_a == moves_b) return;
        place.closing = moves_a ? largestSpeed(twist.twist, pair.centre_a, pair.radius_a)
                                : largestSpeed(twist.twist, pair.centre_b, pair.radius_b);
      });
}

const MessagePlaces::Places& MessagePlaces::asMeasured(const Constraints& message, double scale) {
  return make(
      message,
      [&](const Constraint& /*row*/, GuardPlace& place) {
        place.closing = unscaled(place, scale);
        place.measured = kNotComputed;
      },
      [&](const UnlistedPair& /*pair*/, GuardPlace& place) { place.kind = GuardPlace::Kind::Unknown; });
}

}  // namespace concave_distance
