#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <dynamic_reconfigure/Reconfigure.h>

#include <cmath>
#include <string>

#include "rostest_support.h"

namespace concave_distance {

/// The node under test.
inline const std::string kNode = "/concave_distance/";
/// Metres: of lengths of order 1 after a few operations, far above the error of a proof.
inline constexpr double kRounding = 1e-12;

/// The value of a key in the node's diagnostics; empty when there is none.
inline std::string diagnosed(const diagnostic_msgs::DiagnosticArray& message, const std::string& key) {
  for (const auto& status : message.status) {
    for (const auto& value : status.values) {
      if (status.name.find("concave_distance: ") == 0 && value.key == key) return value.value;
    }
  }
  return "";
}

/// The same as a number; NaN when there is none.
inline double counted(const diagnostic_msgs::DiagnosticArray& message, const std::string& key) {
  const std::string value = diagnosed(message, key);
  return value.empty() ? std::nan("") : std::stod(value);
}

/// Sets one of the node's parameters while it runs. @return what holds afterwards, as the client sees it
inline dynamic_reconfigure::Config reconfigure(const std::string& name, double value) {
  dynamic_reconfigure::ReconfigureRequest request;
  request.config.doubles.resize(1);
  request.config.doubles[0].name = name;
  request.config.doubles[0].value = value;
  return call<dynamic_reconfigure::Reconfigure>(kNode + "set_parameters", request).config;
}
/// The same of a parameter that may be a word instead of a number.
inline dynamic_reconfigure::Config reconfigure(const std::string& name, const std::string& value) {
  dynamic_reconfigure::ReconfigureRequest request;
  request.config.strs.resize(1);
  request.config.strs[0].name = name;
  request.config.strs[0].value = value;
  return call<dynamic_reconfigure::Reconfigure>(kNode + "set_parameters", request).config;
}

}  // namespace concave_distance
