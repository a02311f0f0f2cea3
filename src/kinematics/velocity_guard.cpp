#include "concave_distance/kinematics/velocity_guard.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/number_text.h"
#include "closing_meter.h"
#include "concave_distance/base/error.h"

namespace concave_distance {
namespace {

/// m/s; slower than a millimetre in a quarter of an hour is rounding and no approach.
constexpr double kStill = 1e-6;

/// The number e: commands in a loop fall while the robot still obeys earlier ones. A loop with a delay does
/// not overshoot where its gain, here at most 1 / (e reaction_time), times the delay is at most 1 / e.
constexpr double kDelayFactor = 2.718281828459045;

void require(bool is_allowed, const char* name, double value, const char* allowed) {
  if (!is_allowed || !std::isfinite(value)) {
    throw Error(name, "it is " + numberText(value), allowed);
  }
}

void check(const GuardSettings& settings) {
  require(settings.margin >= 0.0, "margin", settings.margin, "give metres, 0 or more");
  require(settings.reaction_time >= 0.0, "reaction_time", settings.reaction_time, "give seconds, 0 or more");
  require(settings.deceleration > 0.0, "deceleration", settings.deceleration, "give m/s^2, more than 0");
  if (settings.joint_deceleration) {
    require(*settings.joint_deceleration > 0.0, "joint_deceleration", *settings.joint_deceleration,
            "give rad/s^2 or m/s^2, more than 0, or none");
  }
  require(settings.stale_after > 0.0, "stale_after", settings.stale_after, "give seconds, more than 0");
  require(settings.rise_time >= 0.0, "rise_time", settings.rise_time, "give seconds, 0 or more");
}

/// Holds what one place allows, and what is said of it.
struct Limit {
  double scale = 1.0;
  GuardReason reason = GuardReason::Free;
  double room = kNotComputed;
  double closing = kNotComputed;
  double stopping_distance = kNotComputed;
};

Limit limitOf(const GuardPlace& place, double braking_time, const GuardSettings& settings) {
  if (place.kind == GuardPlace::Kind::Unknown) return {0.0, GuardReason::Unknown};
  if (place.kind == GuardPlace::Kind::Overlaps) return {0.0, GuardReason::Overlaps};
  if (!std::isfinite(place.value) || !std::isfinite(place.closing)) return {0.0, GuardReason::NotFinite};
  if (place.closing <= kStill) return {};
  if (!std::isfinite(place.drift)) return {0.0, GuardReason::Unknown, place.value - settings.margin};
  // The speed that the robot has counts where it is more than what it is told.
  const double own = place.measured - place.drift;
  const double speed = own > place.closing ? own : place.closing;
  const double drift = std::max(0.0, place.drift);
  const double brakes = std::max(braking_time, speed / settings.deceleration);
  Limit limit;
  limit.room = place.value - settings.margin;
  limit.closing = speed + drift;
  const double lag = kDelayFactor * settings.reaction_time;
  limit.stopping_distance = speed * lag + drift * settings.reaction_time + (0.5 * speed + drift) * brakes;
  limit.scale = largestScale(limit.room + drift * (lag - settings.reaction_time), speed, drift, lag, brakes);
  limit.reason = limit.scale < 1.0 ? GuardReason::Closing : GuardReason::Free;
  return limit;
}

}  // namespace

double largestScale(double room, double closing, double drift, double reaction_time, double braking_time) {
  const double approach = std::max(0.0, drift);
  const double left = room - approach * reaction_time;
  if (!(left > 0.0)) return 0.0;
  const double square = 0.5 * closing * braking_time;
  const double linear = closing * reaction_time + approach * braking_time;
  // The root of square s^2 + linear s - left without cancellation; both 0: nothing is travelled.
  const double sum = linear + std::sqrt(linear * linear + 4.0 * square * left);
  return sum > 2.0 * left ? 2.0 * left / sum : 1.0;
}

struct VelocityGuard::Parts {
  GuardSettings settings;
  GuardDecision decision;
  bool has_decided = false;
  double last_now = 0.0;
  std::vector<GuardPlace> places;
  detail::ClosingMeter meter;

  /// Returns false when the clock has jumped back.
  bool checkClock(double now) {
    if (!has_decided || now >= last_now) return true;
    meter.reset();
    decision = {};
    return false;
  }
  const GuardDecision& settle(const Limit& limit, std::size_t id, double now) {
    const double elapsed = has_decided ? std::max(0.0, now - last_now) : 0.0;
    const double highest = settings.rise_time > 0.0 ? decision.scale + elapsed / settings.rise_time : 1.0;
    decision.scale = std::min(limit.scale, highest);
    decision.reason = decision.scale < limit.scale ? GuardReason::Rising : limit.reason;
    decision.id = id;
    decision.room = limit.room;
    decision.closing = limit.closing;
    decision.stopping_distance = limit.stopping_distance;
    has_decided = true;
    last_now = now;
    return decision;
  }
  void readRows(const ConstraintRows& rows, const Eigen::Ref<const Eigen::VectorXd>& velocities,
                double stamp);
  void readUnlisted(const ConstraintRows& rows, const Eigen::Ref<const Eigen::VectorXd>& velocities);
};

VelocityGuard::VelocityGuard(const GuardSettings& settings) : parts_(std::make_unique<Parts>()) {
  check(settings);
  parts_->settings = settings;
}
VelocityGuard::~VelocityGuard() = default;
VelocityGuard::VelocityGuard(VelocityGuard&&) noexcept = default;
VelocityGuard& VelocityGuard::operator=(VelocityGuard&&) noexcept = default;

const GuardDecision& VelocityGuard::last() const {
  return parts_->decision;
}

void VelocityGuard::reset() {
  parts_->decision = {};
  parts_->has_decided = false;
  parts_->meter.reset();
}

const GuardDecision& VelocityGuard::stop(GuardReason reason, double now) {
  parts_->checkClock(now);
  return parts_->settle({0.0, reason}, GuardDecision::kNone, now);
}

const GuardDecision& VelocityGuard::decide(const std::vector<GuardPlace>& places, double braking_time,
                                           double stamp, double now) {
  Parts& parts = *parts_;
  if (!std::isfinite(braking_time)) return stop(GuardReason::NotFinite, now);
  if (!parts.checkClock(now)) return stop(GuardReason::ClockBack, now);
  if (!(std::abs(now - stamp) <= parts.settings.stale_after)) return stop(GuardReason::Stale, now);
  Limit least;
  std::size_t id = GuardDecision::kNone;
  for (const GuardPlace& place : places) {
    const Limit limit = limitOf(place, braking_time, parts.settings);
    if (limit.scale >= least.scale) continue;
    least = limit;
    id = place.id;
  }
  return parts.settle(least, id, now);
}

const GuardDecision& VelocityGuard::decide(const ConstraintRows& rows,
                                           const Eigen::Ref<const Eigen::VectorXd>& velocities, double stamp,
                                           double now) {
  Parts& parts = *parts_;
  if (velocities.size() != rows.jacobian().cols()) {
    throw Error("velocities", std::to_string(velocities.size()) + " numbers",
                "give " + std::to_string(rows.jacobian().cols()) + ", one for each of velocityNames()");
  }
  if (!velocities.allFinite()) return stop(GuardReason::NotFinite, now);
  parts.places.clear();
  parts.readRows(rows, velocities, stamp);
  parts.readUnlisted(rows, velocities);
  const double fastest = velocities.size() == 0 ? 0.0 : velocities.cwiseAbs().maxCoeff();
  const auto& joint_deceleration = parts.settings.joint_deceleration;
  return decide(parts.places, joint_deceleration ? fastest / *joint_deceleration : 0.0, stamp, now);
}

void VelocityGuard::Parts::readRows(const ConstraintRows& rows,
                                    const Eigen::Ref<const Eigen::VectorXd>& velocities, double stamp) {
  meter.begin(rows.rows().size(), stamp);
  for (std::size_t slot = 0; slot < rows.rows().size(); ++slot) {
    const ConstraintRow& row = rows.rows()[slot];
    if (row.state != SlotState::Used) continue;
    GuardPlace& place = places.emplace_back();
    place.id = slot;
    if (row.is_overlapping) place.kind = GuardPlace::Kind::Overlaps;
    place.value = row.value;
    place.closing = -rows.jacobian().row(static_cast<Eigen::Index>(slot)).dot(velocities);
    place.drift = row.drift;
    place.measured = meter.measure(slot, row.niche_id, row.age, row.value);
  }
}

void VelocityGuard::Parts::readUnlisted(const ConstraintRows& rows,
                                        const Eigen::Ref<const Eigen::VectorXd>& velocities) {
  for (std::size_t i = 0; i < rows.unlisted().size(); ++i) {
    const UnlistedPlaces& unlisted = rows.unlisted()[i];
    GuardPlace& place = places.emplace_back();
    place.id = rows.rows().size() + i;
    place.kind = std::isnan(unlisted.lower_bound) ? GuardPlace::Kind::Unknown : GuardPlace::Kind::Bound;
    place.value = unlisted.lower_bound;
    place.closing = rows.reach().row(static_cast<Eigen::Index>(i)).dot(velocities.cwiseAbs());
    place.drift = unlisted.drift;
  }
}

}  // namespace concave_distance
