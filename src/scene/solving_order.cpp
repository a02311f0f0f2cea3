#include "solving_order.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace concave_distance {
namespace {

constexpr double kHorizon = 0.1;  // s that a closing speed is taken to go on

double expectedDistance(const PairUrgency& pair) {
  if (std::isnan(pair.distance)) return -std::numeric_limits<double>::infinity();
  const double speed = std::isnan(pair.closing_speed) ? 0.0 : std::max(0.0, pair.closing_speed);
  return std::max(0.0, pair.distance - kHorizon * speed);
}

std::uint32_t overdue(const PairUrgency& pair) {
  const std::uint32_t waited = pair.is_long ? pair.cycles_waited / kCyclesOfLong : pair.cycles_waited;
  return waited < kLongestWait ? 0 : waited;
}

}  // namespace

bool isMoreUrgent(const PairUrgency& l, const PairUrgency& r) {
  if (l.is_last != r.is_last) return r.is_last;
  if (overdue(l) != overdue(r)) return overdue(l) > overdue(r);
  if (l.is_long != r.is_long) return r.is_long;
  if (l.owns_cycle != r.owns_cycle) return l.owns_cycle;
  const double distance_l = expectedDistance(l);
  const double distance_r = expectedDistance(r);
  if (distance_l != distance_r) return distance_l < distance_r;
  return l.cycles_waited > r.cycles_waited;
}

}  // namespace concave_distance
