#include "pair_metric.h"

#include <limits>

namespace concave_distance {
namespace {

// No path is shorter than the straight line, but for the single precision of the paths' lengths.
bool straightLineExceeds(const MeshMetricQuery& query, NodeIndex from, NodeIndex to, double bound) {
  constexpr double kRounding = 1.0 + 1e-5;
  const std::vector<Eigen::Vector3d>& positions = query.metric().graph().positions;
  const double least = (positions[from.value] - positions[to.value]).squaredNorm();
  return least > kRounding * bound * bound;
}

}  // namespace

double PairMetric::distanceWithin(const TrialPoint& x, const TrialPoint& y, double bound) {
  MeshMetricQuery& metric_a = onA();
  MeshMetricQuery& metric_b = onB();
  if (straightLineExceeds(metric_a, x.node_a, y.node_a, bound) ||
      straightLineExceeds(metric_b, x.node_b, y.node_b, bound)) {
    return std::numeric_limits<double>::infinity();
  }
  const double on_a = metric_a.distanceWithin(x.node_a, y.node_a, bound);
  if (!(on_a <= bound)) {
    return std::numeric_limits<double>::infinity();
  }
  const double sum = on_a + metric_b.distanceWithin(x.node_b, y.node_b, bound - on_a);
  // bound - on_a is rounded, so the sum may miss the bound by a last place.
  return sum <= bound ? sum : std::numeric_limits<double>::infinity();
}

}  // namespace concave_distance
