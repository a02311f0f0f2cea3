#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "yaml_value.h"

// Kinds of values that settings have, with the words that messages name them by.

namespace concave_distance::detail {

inline constexpr std::uint64_t kMost32 = std::numeric_limits<std::uint32_t>::max();

inline bool positiveFinite(double v) {
  return v > 0.0 && std::isfinite(v);
}
inline bool notNegativeFinite(double v) {
  return v >= 0.0 && std::isfinite(v);
}
inline bool share(double v) {
  return v >= 0.0 && v <= 1.0;
}

inline constexpr const char* kLength = "greater than 0, metres";
inline constexpr const char* kShare = "from 0 to 1";

inline std::uint32_t count32(const YamlValue& value, std::uint64_t least, std::uint64_t most = kMost32,
                             const std::string& remark = "") {
  return static_cast<std::uint32_t>(value.count(least, most, remark));
}

// A number of the predicate's kind, or the word that stands for "empty".
template <typename Predicate>
std::optional<double> optionalNumber(const YamlValue& value, const char* word, const std::string& allowed,
                                     const Predicate& accepts) {
  if (value.isText(word)) return std::nullopt;
  return value.number(allowed + ", or " + word, accepts);
}

}  // namespace concave_distance::detail
