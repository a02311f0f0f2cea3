#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/parameter.h"
#include "concave_distance/kinematics/velocity_guard.h"

namespace concave_distance {

/// Says what a guard is given to scale.
enum class GuardCommandKind : std::uint8_t {
  None,             ///< nothing: only the scale is published, by speeds as they are measured
  JointVelocities,  ///< std_msgs/Float64MultiArray
  Twist,            ///< geometry_msgs/TwistStamped
  CmdVel            ///< geometry_msgs/Twist
};

/// Every private parameter of velocity_guard, validated (doc/velocity_guard.md). SI units.
struct GuardParameters {
  std::string constraints_topic = "/concave_distance/constraints";
  std::string scale_topic = "/servo_server/internal/collision_velocity_scale";
  GuardCommandKind command = GuardCommandKind::None;
  std::optional<std::vector<std::string>> joints;
  std::string twist_frame;
  double command_timeout = 0.2;
  double rate = 50.0;
  GuardSettings guard;
};

/// The parameters, declared once.
const ParameterTable<GuardParameters>& guardParameterTable();
/// @param unknown names that are no parameter
/// @throws Error naming the parameter, the value seen and what is allowed
GuardParameters parseGuardParameters(const XmlRpc::XmlRpcValue& values, std::vector<std::string>& unknown);

}  // namespace concave_distance
