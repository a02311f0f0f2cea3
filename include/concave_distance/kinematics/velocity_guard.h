#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "concave_distance/base/not_computed.h"
#include "concave_distance/kinematics/constraint_rows.h"

namespace concave_distance {

/// Says what a guard keeps, and what it takes for granted of the robot.
struct GuardSettings {
  double margin = 0.02;  ///< metres that every place keeps
  /// s from the poses of a row until the robot obeys; its own speed counts e times as long, so that the loop
  /// of guard and robot does not overshoot
  double reaction_time = 0.1;
  double deceleration = 1.0;  ///< m/s^2 that a closing speed falls by at least, once the robot brakes
  /// rad/s^2, or m/s^2 of sliding joints: where all joints brake together, the one that takes longest
  /// decides; empty: `deceleration` alone.
  std::optional<double> joint_deceleration;
  double stale_after = 0.2;  ///< s; rows older than that, or stamped as much later than now, count as none
  double rise_time = 0.25;   ///< s that the scale takes from 0 to 1 at least; it falls at once
};

/// Describes one place that a guard looks at.
struct GuardPlace {
  enum class Kind : std::uint8_t {
    Row,       ///< a place of a known distance
    Bound,     ///< places that are no nearer than `value` and come no faster than `closing`
    Overlaps,  ///< bodies that overlap there, in a direction that is not known
    Unknown    ///< nothing is known of it
  };
  Kind kind = Kind::Row;
  std::size_t id = 0;              ///< the caller's
  double value = kNotComputed;     ///< metres, signed
  double closing = 0.0;            ///< m/s at scale 1, by what the scale scales; positive when approaching
  double drift = 0.0;              ///< m/s by all else; NaN: not known
  double measured = kNotComputed;  ///< m/s, all together as it is now; NaN: not known
};

/// Says what decided a scale.
enum class GuardReason : std::uint8_t {
  Free,       ///< nothing that closes is near
  Closing,    ///< a place that closes: its stopping distance is what is left
  Rising,     ///< it was less, and rises no faster than GuardSettings::rise_time
  NoRows,     ///< there were no rows yet
  Stale,      ///< the rows are too old, or stamped later than now
  ClockBack,  ///< the clock jumped back
  Unknown,    ///< of places that are near nothing, or too little, is known
  Overlaps,   ///< bodies overlap, and in which direction is not known
  NotFinite,  ///< a number is not finite: of the command or of a row
  BadCommand  ///< the caller's: the command cannot be read
};

struct GuardDecision {
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  double scale = 0.0;  ///< 0 to 1, to multiply the whole command with
  GuardReason reason = GuardReason::NoRows;
  std::size_t id = kNone;                   ///< GuardPlace::id of the place that decided
  double room = kNotComputed;               ///< metres: its value less the margin
  double closing = kNotComputed;            ///< m/s at scale 1, with its drift
  double stopping_distance = kNotComputed;  ///< metres at scale 1
};

/// Returns the largest scale in [0, 1] with which a place stops before its margin: with s, the robot closes s
/// * closing for the reaction time and then brakes for s * braking_time, while the drift goes on.
///
///     s closing T + s^2 closing braking_time / 2 + drift (T + s braking_time) <= room
///
/// @param room metres @param closing m/s, more than 0 @param drift m/s; one that opens is not counted on
/// @param braking_time s from speed at scale 1 to rest
double largestScale(double room, double closing, double drift, double reaction_time, double braking_time);

/// A scale for velocity commands from the places that close; those that open limit nothing. Not a safety
/// device. One thread at a time; after the first calls nothing is allocated.
class VelocityGuard {
 public:
  /// @throws Error for settings that are not finite, negative, or 0 where they divide
  explicit VelocityGuard(const GuardSettings& settings = {});
  ~VelocityGuard();
  VelocityGuard(VelocityGuard&&) noexcept;
  VelocityGuard& operator=(VelocityGuard&&) noexcept;

  /// Forgets the last scale: the next rises from 0.
  void reset();

  /// Decides by the rows of a cycle. What is not listed (ConstraintRows::unlisted()) counts as coming at the
  /// speed that it can have at most, from where it can be.
  /// @param velocities the command, in the order of SceneKinematics::velocityNames(), rad/s and m/s
  /// @param stamp seconds of the rows' poses @param now seconds of the same clock
  /// @throws Error for another number of velocities
  const GuardDecision& decide(const ConstraintRows& rows, const Eigen::Ref<const Eigen::VectorXd>& velocities,
                              double stamp, double now);
  /// Decides by places that the caller has made. @param braking_time s that the command needs to rest, by
  /// what brakes longest; 0: as `deceleration` says
  const GuardDecision& decide(const std::vector<GuardPlace>& places, double braking_time, double stamp,
                              double now);
  /// Decides 0, for a reason of the caller's.
  const GuardDecision& stop(GuardReason reason, double now);
  const GuardDecision& last() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace concave_distance
