#pragma once

#include <string>

#include "base/ascii.h"

namespace concave_distance {

/// Returns a name as part of a topic's: links may be called `link-1` or `arm.2`, topics may not.
inline std::string topicName(std::string name) {
  for (char& c : name) {
    const bool allowed = isLetterOrDigit(c) || c == '_' || c == '/';
    c = allowed ? c : '_';
  }
  return name;
}

}  // namespace concave_distance
