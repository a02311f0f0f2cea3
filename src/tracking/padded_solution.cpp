#include "padded_solution.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace concave_distance {
namespace {

/// Pads what a solution and a niche have in common. Where the bare surfaces meet there is nothing to move
/// along.
template <typename Place>
void padPlace(const TrackerParameters& parameters, Place& place) {
  const double bare = place.distance;
  place.signed_distance = kNotComputed;
  if (!(bare > 0.0)) return;
  place.signed_distance = bare - parameters.margin();
  place.distance = std::max(0.0, place.signed_distance);
  if (!(parameters.margin() > 0.0)) return;
  const Eigen::Vector3d along = (place.point_b_in_a - place.point_a_in_a).normalized();
  place.point_a_in_a += parameters.margin_a * along;
  place.point_b_in_a -= parameters.margin_b * along;
  // Where margins overlap, the points no longer tell it.
  if (!place.normal_in_a.allFinite()) place.normal_in_a = along;
}

}  // namespace

void padSolution(const TrackerParameters& parameters, PairSolution& solution) {
  for (TrackedNiche& niche : solution.niches) padPlace(parameters, niche);
  padPlace(parameters, solution);
  if (!(parameters.margin() > 0.0)) return;
  if (solution.lower_bound > 0.0) {
    const double lower =
        std::nextafter(solution.lower_bound - parameters.margin(), -std::numeric_limits<double>::infinity());
    solution.lower_bound = std::max(0.0, lower);
  }
  if (solution.signed_distance <= 0.0) solution.status = SolveStatus::Penetrating;
}

}  // namespace concave_distance
