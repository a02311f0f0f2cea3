#pragma once

#include <cstdint>

#include "concave_distance/base/not_computed.h"

namespace concave_distance {

/// Says how soon a pair has to be solved in a cycle that may end before all are.
struct PairUrgency {
  double distance = kNotComputed;       ///< metres, the last one known; NaN: none
  double closing_speed = kNotComputed;  ///< m/s, positive when approaching; NaN: not known
  std::uint32_t cycles_waited = 0;      ///< cycles in a row that have left its list unfinished
  bool is_long = false;                 ///< its list is expected to need much of a cycle's time
  bool owns_cycle = false;              ///< it is the turn of this long list to take what it needs
  bool is_last = false;                 ///< its list comes after all that are not
};

/// A pair that has waited for this many cycles comes before all that have waited less, however near they are.
constexpr std::uint32_t kLongestWait = 3;
/// A long list takes its time from many: so many cycles of its wait count as one.
constexpr std::uint32_t kCyclesOfLong = 4;

/// Returns whether pair l is solved before pair r: the last lists after all others, then what has waited long
/// first, then lists that need little, of the others those that own the cycle, and of equals in this the
/// nearest, each where its closing speed takes it within a tenth of a second. A pair without a distance may
/// be the nearest. It is a strict weak order.
bool isMoreUrgent(const PairUrgency& l, const PairUrgency& r);

}  // namespace concave_distance
