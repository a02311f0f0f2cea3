#pragma once

#include <string>

#include "concave_distance/tracking/pair_solution.h"
#include "concave_distance/tracking/tracker_parameters.h"
#include "fuzz/niche_enumeration.h"

namespace concave_distance::test {

/// What is wrong with the package's answer at level `certified` and these parameters, as the enumeration has
/// it: an empty text when nothing is. Places, distances, order, flags, prominences, cuts, the distance and
/// its bound are compared.
/// @param shells_cross within a body: which of the places where the surfaces meet lie in the material of
/// another
///        shell is not known, and none of them is missed
std::string complaintAbout(const PairSolution& solution, const TrackerParameters& parameters,
                           const NicheEnumeration& enumeration, bool shells_cross = false);

}  // namespace concave_distance::test
