#pragma once

#include <cstdint>

#include "concave_distance/base/not_computed.h"

namespace concave_distance {

/// Says how soon a pair has to be solved in a cycle that may end before all are.
struct PairUrgency {
  double distance = kNotComputed;       ///< metres, the last one known; NaN: none
  double closing_speed = kNotComputed;  ///< m/s, positive when approaching; NaN: not known
  std::uint32_t cycles_waited = 0;      ///< cycles in a row that have left its list unfinished
};

/// A pair that has waited for this many cycles comes before all that have waited less, however near they are.
constexpr std::uint32_t kLongestWait = 3;

/// Returns whether pair l is solved before pair r: what has waited long first, then the nearest, each where
/// its closing speed takes it within a tenth of a second. A pair without a distance may be the nearest. It is
/// a strict weak order.
bool isMoreUrgent(const PairUrgency& l, const PairUrgency& r);

}  // namespace concave_distance
