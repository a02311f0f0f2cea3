#pragma once

#include "concave_distance/tracking/pair_solution.h"
#include "concave_distance/tracking/tracker_parameters.h"

namespace concave_distance {

/// Makes the solution of a pair's bare surfaces that of the surfaces moved out by the bodies' margins:
/// distances and the lower bound fall by both margins, points move along their segment by each body's. Where
/// only margins overlap the status is penetrating. Gives the signed distances, also without margins.
void padSolution(const TrackerParameters& parameters, PairSolution& solution);

}  // namespace concave_distance
