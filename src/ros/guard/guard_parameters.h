#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <optional>
#include <string>
#include <vector>

#include "base/parameter.h"
#include "concave_distance/kinematics/velocity_guard.h"

namespace concave_distance {

/// Every private parameter of velocity_guard, validated (doc/velocity_guard.md). SI units. The command is
/// joint velocities where `joints` are named, a twist where `twist_frame` is, else there is none.
struct GuardParameters {
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
