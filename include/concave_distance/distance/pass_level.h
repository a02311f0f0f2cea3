#pragma once

#include <Eigen/Geometry>

#include "concave_distance/distance/witness_refinement.h"

namespace concave_distance {

/// An upper bound of the pass between two local minima: the largest squared distance met on a way that leads
/// from one witness pair to the other over both surfaces. Three ways are tried: both points along their
/// chords; A's along its chord while B's stays closest to it; and the same with the bodies exchanged. The
/// search stops at the first way below `good_enough`. Infinite when no way arrives (e.g. across a groove).
/// Between `samples` positions a way is followed triangle by triangle, not measured: a ridge or groove
/// narrower than a sample is stepped over only if the surface itself leads across it.
/// Square metres. O(samples), allocates nothing.
double passLevel(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                 const WitnessPair& from, const WitnessPair& to, int samples, double good_enough);

}  // namespace concave_distance
