#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "loading/parameter_map.h"

// Kinds of values that experiments have beside those of settings.

namespace concave_distance::detail {

inline constexpr std::uint64_t kMost32 = std::numeric_limits<std::uint32_t>::max();
inline constexpr const char* kShare = "from 0 to 1";

inline bool share(double v) {
  return v >= 0.0 && v <= 1.0;
}

inline std::uint32_t count32(const YamlValue& value, std::uint64_t least, std::uint64_t most = kMost32,
                             const std::string& remark = "") {
  return static_cast<std::uint32_t>(value.count(least, most, remark));
}

}  // namespace concave_distance::detail
