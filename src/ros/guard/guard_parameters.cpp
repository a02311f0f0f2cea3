#include "guard_parameters.h"

#include <set>

#include "concave_distance/base/error.h"
#include "kinematics/frame_name.h"
#include "ros/node/parameter_reader.h"

namespace concave_distance {

const ParameterTable<GuardParameters>& guardParameterTable() {
  using P = GuardParameters;
  static const ParameterTable<P> table = {
      list<P>(
          "joints", "a list of names", [](auto& p) -> auto& { return p.joints; },
          "the order of `~joint_velocities`: names as in `constraints`, with their robot's prefix"),
      text<P>(
          "twist_frame", "a tf frame", [](auto& p) -> auto& { return p.twist_frame; },
          "instead of `joints`: the link that `~twist` moves, with all that hangs on it"),
      number<P>(
          "command_timeout", [](auto& p) -> auto& { return p.command_timeout; },
          "a command that is older counts as one of zeros")
          .inUnit("s")
          .from(0.001)
          .to(60.0),
      number<P>(
          "rate", [](auto& p) -> auto& { return p.rate; },
          "publications a second at least; besides, at each message that comes")
          .inUnit("Hz")
          .from(1.0)
          .to(10000.0),
      number<P>(
          "margin", [](auto& p) -> auto& { return p.guard.margin; }, "distance that every place keeps")
          .inUnit("m")
          .to(100.0),
      number<P>(
          "reaction_time", [](auto& p) -> auto& { return p.guard.reaction_time; },
          "from the transforms of a row until the robot obeys: cycle, topics, controller, drive")
          .inUnit("s")
          .to(10.0),
      number<P>(
          "deceleration", [](auto& p) -> auto& { return p.guard.deceleration; },
          "that a closing speed falls by at least, once the robot brakes")
          .inUnit("m/s^2")
          .above(0.0)
          .to(1e6),
      optionalNumber<P>(
          "joint_deceleration", "none", [](auto& p) -> auto& { return p.guard.joint_deceleration; },
          "of every joint (m/s^2 where it slides) or of a twist's turning: where all brake together, the one "
          "that takes longest decides")
          .inUnit("rad/s^2")
          .above(0.0)
          .to(1e6),
      number<P>(
          "stale_after", [](auto& p) -> auto& { return p.guard.stale_after; },
          "rows whose transforms are older, or stamped so much later than now, stop the robot")
          .inUnit("s")
          .above(0.0)
          .to(10.0),
      number<P>(
          "rise_time", [](auto& p) -> auto& { return p.guard.rise_time; },
          "that the scale takes from 0 to 1 at least; it falls at once")
          .inUnit("s")
          .to(60.0),
  };
  return table;
}

GuardParameters parseGuardParameters(const XmlRpc::XmlRpcValue& values, std::vector<std::string>& unknown) {
  ParameterReader reader(values, "~");
  GuardParameters parameters;
  reader.read(guardParameterTable(), false, parameters);
  unknown = reader.unread({});
  if (parameters.joints) {
    const std::set<std::string> names(parameters.joints->begin(), parameters.joints->end());
    if (names.empty() || names.size() != parameters.joints->size()) {
      throw Error("~joints", "it is empty or names a joint twice", "name each in the order of the command");
    }
    if (!parameters.twist_frame.empty()) {
      throw Error("~twist_frame", "~joints are given too", "give one of them");
    }
  } else if (!parameters.twist_frame.empty()) {
    parameters.twist_frame = requireFrameName(parameters.twist_frame, "~twist_frame");
  }
  return parameters;
}

}  // namespace concave_distance
