#pragma once

#include <cstdint>

namespace concave_distance {

struct LocalMinimaCost {
  std::uint64_t node_pairs = 0;      ///< of the cone trees
  std::uint64_t feature_pairs = 0;   ///< whose distance was computed
  std::uint64_t candidates = 0;      ///< triangle pairs tried for a local minimum
  std::uint64_t minima = 0;          ///< triangle pairs that hold one, before ripples are united
  std::uint64_t searched_pairs = 0;  ///< facet pairs visited to decide and to measure prominences
  /// Niches of the result that no cone led to but the search ran into. A rounding more than the widened cones
  /// allow for would show here; none has.
  std::uint64_t met_by_search = 0;
  double sweep_seconds = 0.0;  ///< of the look for minima; the rest of the time is for what becomes of them
};

}  // namespace concave_distance
