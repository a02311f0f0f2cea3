#pragma once

#include <cstdint>
#include <cstdlib>
#include <string>

/// How many cases a property test draws, and from which seed: fixed in every build, larger and fresh when the
/// environment says so. Tests print the seed and the number of the case that fails.
namespace concave_distance::test {

/// CONCAVE_DISTANCE_PROPERTY_CASES, or the number given.
inline std::uint64_t propertyCases(std::uint64_t usual) {
  const char* const given = std::getenv("CONCAVE_DISTANCE_PROPERTY_CASES");
  return given != nullptr ? std::stoull(given) : usual;
}

/// CONCAVE_DISTANCE_PROPERTY_SEED, or 1.
inline std::uint64_t propertySeed() {
  const char* const given = std::getenv("CONCAVE_DISTANCE_PROPERTY_SEED");
  return given != nullptr ? std::stoull(given) : 1;
}

}  // namespace concave_distance::test
