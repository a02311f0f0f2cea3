#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "base/parameter.h"
#include "yaml_value.h"

namespace concave_distance::detail {

/// The value of a parameter. @throws Error naming file, line and key, the value seen and what is allowed
ParameterValue readParameter(const YamlValue& value, const ParameterInfo& info);

/// Sets what the map says and leaves the rest. Takes the names of the parameters from the map.
/// @param is_expert which of them: those below `expert`, or the others
template <typename Settings>
void readParameters(YamlMap& map, const ParameterTable<Settings>& table, bool is_expert, Settings& settings) {
  for (const Parameter<Settings>& parameter : table) {
    if (parameter.info.is_expert != is_expert) continue;
    if (const auto value = map.take(parameter.info.name)) {
      parameter.set(settings, readParameter(*value, parameter.info));
    }
  }
}

// Kinds of values that settings have, with the words that messages name them by.

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
