#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "yaml_value.h"

// Kinds of values that settings have, with the words that messages name them by.

namespace concave_distance::detail {

inline bool positiveFinite(double v) {
  return v > 0.0 && std::isfinite(v);
}
inline bool notNegativeFinite(double v) {
  return v >= 0.0 && std::isfinite(v);
}

inline constexpr const char* kLength = "greater than 0, metres";

// A number of the predicate's kind, or the word that stands for "empty".
template <typename Predicate>
std::optional<double> optionalNumber(const YamlValue& value, const char* word, const std::string& allowed,
                                     const Predicate& accepts) {
  if (value.isText(word)) return std::nullopt;
  return value.number(allowed + ", or " + word, accepts);
}

}  // namespace concave_distance::detail
