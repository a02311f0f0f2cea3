#pragma once

#include <functional>
#include <optional>
#include <string>

namespace concave_distance {

/// A text on the parameter server, and the parameter that holds it.
struct FoundDescription {
  std::string key;
  std::string text;
  bool is_xml = false;  ///< false: the nearest parameter of that name holds something else
};

/// Reads a parameter by its full name; nothing when it is not set or not a text.
using ParameterText = std::function<std::optional<std::string>(const std::string& key)>;

/// Looks for a URDF or SRDF in the private namespace, then in the namespaces above it. A private parameter of
/// the same name may instead hold the name of the parameter to read (~robot_description: robot_description);
/// so a private value that is not XML is skipped.
/// @param name relative, or absolute with a leading slash: then only that parameter is read
/// @return the nearest XML; without one, the nearest other text outside the private namespace
std::optional<FoundDescription> searchDescription(const std::string& private_namespace,
                                                  const std::string& name, const ParameterText& read);

}  // namespace concave_distance
