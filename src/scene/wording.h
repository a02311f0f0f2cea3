#pragma once

#include <cstddef>
#include <string>

namespace concave_distance::detail {

/// "1 pair", "2 pairs".
inline std::string counted(std::size_t count, const std::string& thing) {
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

}  // namespace concave_distance::detail
