#pragma once

#include <cstdint>

namespace concave_distance {

/// A counter of a struct of costs, as the diagnostics report it.
template <typename Cost>
struct CostCounter {
  const char* key;
  std::uint64_t (*of)(const Cost&);
};

}  // namespace concave_distance
