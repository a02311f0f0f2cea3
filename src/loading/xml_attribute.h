#pragma once

#include <tinyxml2.h>

#include <string>

namespace concave_distance::detail {

/// Empty when the element has no such attribute.
inline std::string attribute(const tinyxml2::XMLElement& element, const char* name) {
  const char* value = element.Attribute(name);
  return value != nullptr ? value : std::string();
}

}  // namespace concave_distance::detail
