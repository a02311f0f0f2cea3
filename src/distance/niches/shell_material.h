#pragma once

#include "distance/kernels/pair_frame.h"

namespace concave_distance::detail {

/// Returns whether a witness lies in the material of another shell of its body, where there is no surface. It
/// asks a little before it, on the way to the other witness, or along the normal where the bodies meet.
bool isInsideMaterial(const PairFrame& frame, const WitnessPair& witness);

/// Returns whether two facets that meet do so, somewhere, in no material of other shells of their bodies;
/// what meets in an area is looked at along its longest line.
/// @param closest points of the facet pair, and the triangles that these are on
bool isMeetingInSight(const PairFrame& frame, const TrianglePair& facets, const TrianglePair& triangles,
                      const TrianglePairDistance& closest, double tolerance);

}  // namespace concave_distance::detail
