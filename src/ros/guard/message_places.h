#pragma once

#include <concave_distance/Constraints.h>

#include <functional>
#include <string>
#include <vector>

#include "concave_distance/contact/wrench.h"
#include "concave_distance/kinematics/velocity_guard.h"
#include "kinematics/closing_meter.h"

namespace concave_distance {

/// A twist of all that hangs on a frame, about the origin of the rows' frame and in its axes.
struct GuardTwist {
  RelativeTwist twist;
  std::function<bool(const std::string& frame)> moves;  ///< whether a tf frame hangs on it
};

/// Turns the rows of a message into the places that a guard reads. Ids are places in `rows`, then in
/// `unlisted`.
class MessagePlaces {
 public:
  using Places = std::vector<GuardPlace>;

  /// Takes the speeds of a new message of the topic, from its values and the last one's.
  void measure(const Constraints& message);

  /// @param velocities a number for each of message.joints
  const Places& ofJoints(const Constraints& message, const std::vector<double>& velocities);
  /// Bodies that hang on the frame close by the twist; of all others the speeds are the measured ones.
  /// @param twist nullptr: none, all speeds are measured @param scale in force while they were measured
  const Places& ofTwist(const Constraints& message, const GuardTwist* twist, double scale);

 private:
  /// Makes the places, but for the speeds that a command gives them.
  void begin(const Constraints& message);

  detail::ClosingMeter meter_;
  std::vector<double> measured_;  ///< m/s by slot
  Places places_;
};

}  // namespace concave_distance
