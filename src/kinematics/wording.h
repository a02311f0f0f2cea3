#pragma once

#include <tinyxml2.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace concave_distance::detail {

/// "1 pair", "2 pairs".
inline std::string counted(std::size_t count, const std::string& thing) {
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

/// "a, b and 3 more", with at most `most` of the names.
inline std::string listed(const std::vector<std::string>& names, std::size_t most) {
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i) text += (i == 0 ? "" : ", ") + names[i];
  if (names.size() > most) text += " and " + std::to_string(names.size() - most) + " more";
  return text;
}

/// "line 3: XML_ERROR_MISMATCHED_ELEMENT"; of a document with an error.
inline std::string xmlError(const tinyxml2::XMLDocument& document) {
  return "line " + std::to_string(document.ErrorLineNum()) + ": " + document.ErrorName();
}

/// Empty when the element has no such attribute.
inline std::string attribute(const tinyxml2::XMLElement& element, const char* name) {
  const char* value = element.Attribute(name);
  return value != nullptr ? value : std::string();
}

}  // namespace concave_distance::detail
