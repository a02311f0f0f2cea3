#pragma once

#include <concave_distance/PairContactState.h>

#include <Eigen/Geometry>

#include "concave_distance/tracking/pair_effects.h"
#include "conversions.h"

namespace concave_distance {

/// A pair of which no contacts are known: no region, no wrench, every number NaN.
PairContactState emptyContacts(const PairHeading& heading, const PairStatus& status);

/// The contacts in the reference frame, wrenches about the origin of B's frame.
/// @param status of the pair's distance
/// @param a_from_b the pose that the contacts were found at
PairContactState toContacts(const PairHeading& heading, const PairStatus& status,
                            const PairContacts& contacts, const Eigen::Isometry3d& a_from_b);

}  // namespace concave_distance
