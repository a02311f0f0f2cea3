#pragma once

#include <string>

namespace concave_distance {

/// The text, or its beginning and end, so that a message that quotes a request does not repeat a megabyte.
inline std::string shortText(const std::string& text) {
  constexpr std::size_t kHead = 600;
  constexpr std::size_t kTail = 300;
  if (text.size() <= kHead + kTail) {
    return text;
  }
  return text.substr(0, kHead) + " ... " + text.substr(text.size() - kTail);
}

}  // namespace concave_distance
