#include "motion_paths.h"

#include <algorithm>
#include <cmath>

namespace concave_distance::detail {
namespace {

/// The longest that is looked for a time.
double shareOf(double time, double from, double to) {
  return to > from ? std::clamp((time - from) / (to - from), 0.0, 1.0) : 0.0;
}

}  // namespace

double MotionPaths::timeOf(double moment) const {
  const MotionMoment at = momentAt(moment, segmentCount());
  if (at.share == 0.0 || times.size() == 1) return times[at.segment];
  const double to = times[at.segment + 1];
  return at.share == 1.0 ? to : times[at.segment] + at.share * (to - times[at.segment]);
}

double MotionPaths::momentOf(double time) const {
  if (!(time > times.front())) return 0.0;
  const auto after = std::upper_bound(times.begin(), times.end(), time);
  if (after == times.end()) return end();
  const auto segment = static_cast<std::size_t>(after - times.begin()) - 1;
  return static_cast<double>(segment) + shareOf(time, times[segment], times[segment + 1]);
}

}  // namespace concave_distance::detail
