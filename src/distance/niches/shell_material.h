#pragma once

#include "distance/kernels/pair_frame.h"

namespace concave_distance::detail {

/// Returns whether a witness lies in the material of another shell of its body, where there is no surface. It
/// asks a little before it, on the way to the other witness, or along the normal where the bodies meet.
bool isInsideMaterial(const PairFrame& frame, const WitnessPair& witness);

}  // namespace concave_distance::detail
