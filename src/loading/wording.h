#pragma once

#include <tinyxml2.h>

#include <cstddef>
#include <string>

namespace concave_distance::detail {

/// "1 pair", "2 pairs".
inline std::string counted(std::size_t count, const std::string& thing) {
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

/// "line 3: XML_ERROR_MISMATCHED_ELEMENT"; of a document with an error.
inline std::string xmlError(const tinyxml2::XMLDocument& document) {
  return "line " + std::to_string(document.ErrorLineNum()) + ": " + document.ErrorName();
}

}  // namespace concave_distance::detail
