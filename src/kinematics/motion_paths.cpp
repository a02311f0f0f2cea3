#include "motion_paths.h"

namespace concave_distance::detail {

double MotionPaths::timeOf(double moment) const {
  const MotionMoment at = momentAt(moment, segmentCount());
  if (at.share == 0.0 || times.size() == 1) return times[at.segment];
  const double to = times[at.segment + 1];
  return at.share == 1.0 ? to : times[at.segment] + at.share * (to - times[at.segment]);
}

}  // namespace concave_distance::detail
