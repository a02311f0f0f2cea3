#pragma once

#include "distance/kernels/minima_scene.h"

namespace concave_distance::detail {

/// Whether a witness lies in the material of another shell of its body, where there is no surface: asked a
/// little before it, on the way to the other witness, or along the normal where the bodies meet.
bool isInsideMaterial(const MinimaScene& scene, const WitnessPair& witness);

}  // namespace concave_distance::detail
