#include "concave_distance/search/pair_metric.h"

#include <limits>

namespace concave_distance {

double PairMetric::distanceWithin(const TrialPoint& x, const TrialPoint& y, double bound) {
  const double on_a = a_.distanceWithin(x.node_a, y.node_a, bound);
  if (!(on_a <= bound)) {
    return std::numeric_limits<double>::infinity();
  }
  const double sum = on_a + b_.distanceWithin(x.node_b, y.node_b, bound - on_a);
  // bound - on_a is rounded, so the sum may miss the bound by a last place.
  return sum <= bound ? sum : std::numeric_limits<double>::infinity();
}

}  // namespace concave_distance
