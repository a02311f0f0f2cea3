#pragma once

#include <cstdint>
#include <cstdlib>

#include "base/random_engine.h"

namespace concave_distance::test {

/// Seed of the cases of a test that must hold for any: the same in every run, or, where
/// CONCAVE_DISTANCE_FRESH_SEED is set (scripts/fresh_tests.sh), another one for each value of it.
inline std::uint64_t caseSeed(std::uint64_t usual) {
  const char* const fresh = std::getenv("CONCAVE_DISTANCE_FRESH_SEED");
  return fresh == nullptr ? usual : streamSeed(std::strtoull(fresh, nullptr, 10), "fresh", usual);
}

/// How many cases it draws: as usual, or CONCAVE_DISTANCE_FRESH_CASES.
template <typename Count>
Count caseCount(Count usual) {
  const char* const wanted = std::getenv("CONCAVE_DISTANCE_FRESH_CASES");
  const int count = wanted == nullptr ? 0 : std::atoi(wanted);
  return count < 1 ? usual : static_cast<Count>(count);
}

}  // namespace concave_distance::test
