#include "nearest_row.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace concave_distance::python {

NearestRow nearestOf(const SceneTracker& tracker,
                     const std::vector<std::optional<Eigen::Isometry3d>>& world_from_body) {
  NearestRow row;
  const TrackedPair* nearest = nullptr;
  double bound = tracker.others().lower_bound;
  double others = bound;  // what pairs without a distance, or with one that is not proven, may come down to
  bool all_known = tracker.others().missing == 0;
  for (const auto& pair : tracker.pairs()) {
    const PairSolution& solution = pair->solution;
    if (pair->box_bound) {
      bound = std::min(bound, *pair->box_bound);
      others = std::min(others, *pair->box_bound);
    } else if (!pair->solved() || std::isnan(solution.distance)) {
      all_known = false;
    } else {
      if (nearest == nullptr || solution.distance < nearest->solution.distance) nearest = pair.get();
      bound = std::isnan(solution.lower_bound) ? kNotComputed : std::min(bound, solution.lower_bound);
      if (solution.status != SolveStatus::Ok) others = std::min(others, solution.lower_bound);
    }
  }
  if (all_known) row.lower_bound = bound;
  if (nearest == nullptr) return row;
  const PairSolution& solution = nearest->solution;
  const std::size_t a = nearest->origin->body_a;
  row.distance = solution.distance;
  row.is_minimum = row.distance == 0.0 || (all_known && !(others < row.distance));
  if (row.distance == 0.0) row.lower_bound = 0.0;
  row.status = static_cast<std::uint8_t>(solution.status);
  row.body_a = static_cast<std::int64_t>(a);
  row.body_b = static_cast<std::int64_t>(nearest->origin->body_b);
  row.point_a = tripleOf(*world_from_body[a] * solution.point_a_in_a);
  row.point_b = tripleOf(*world_from_body[a] * solution.point_b_in_a);
  row.normal = tripleOf(world_from_body[a]->linear() * solution.normal_in_a);
  return row;
}

}  // namespace concave_distance::python
