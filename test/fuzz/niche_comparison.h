#pragma once

#include <string>

#include "concave_distance/tracking/pair_solution.h"
#include "concave_distance/tracking/tracker_parameters.h"
#include "fuzz/niche_enumeration.h"

namespace concave_distance::test {

/// What is wrong with the package's answer at level `certified` and these parameters, as the enumeration has
/// it: an empty text when nothing is. Places, distances, order, flags, prominences, cuts, the distance and
/// its bound are compared.
std::string complaintAbout(const PairSolution& solution, const TrackerParameters& parameters,
                           const NicheEnumeration& enumeration);

}  // namespace concave_distance::test
