#include "padded_solution.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace concave_distance {
namespace {

/// Pads what a solution and a niche have in common.
/// @param overlaps the bare bodies do: what is at 0 has no signed distance
template <typename Place>
void padPlace(const TrackerParameters& parameters, bool overlaps, Place& place) {
  const double bare = place.distance;
  const bool is_known = overlaps ? bare > 0.0 : bare >= 0.0;
  place.signed_distance = is_known ? bare - parameters.margin() : kNotComputed;
  if (!is_known || !(parameters.margin() > 0.0)) return;
  place.distance = std::max(0.0, place.signed_distance);
  // Where margins overlap, the points no longer tell the direction.
  if (!place.normal_in_a.allFinite())
    place.normal_in_a = (place.point_b_in_a - place.point_a_in_a).normalized();
  // Where the bare surfaces nearly touch, rounding leaves the normal not quite of length 1.
  const Eigen::Vector3d along = place.normal_in_a.normalized();
  place.point_a_in_a += parameters.margin_a * along;
  place.point_b_in_a -= parameters.margin_b * along;
}

}  // namespace

void padSolution(const TrackerParameters& parameters, PairSolution& solution) {
  const bool overlaps = solution.status == SolveStatus::Penetrating;
  for (TrackedNiche& niche : solution.niches) {
    padPlace(parameters, overlaps, niche);
    if (std::isnan(niche.signed_distance))
      niche.signed_distance = niche.signed_place.value - parameters.margin();
  }
  padPlace(parameters, overlaps, solution);
  if (!(parameters.margin() > 0.0)) return;
  if (solution.lower_bound > 0.0) {
    const double lower =
        std::nextafter(solution.lower_bound - parameters.margin(), -std::numeric_limits<double>::infinity());
    solution.lower_bound = std::max(0.0, lower);
  }
  if (solution.signed_distance <= 0.0) solution.status = SolveStatus::Penetrating;
}

}  // namespace concave_distance
