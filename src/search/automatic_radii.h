#pragma once

#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/search/genetic_parameters.h"

namespace concave_distance {

/// Radii from the geometry of both bodies, so that a user need not set them (the rule and its reason stand in
/// the source and in doc/algorithm.md); explicit values in `parameters` win.
NicheRadii automaticRadii(const BodyMesh& a, const BodyMesh& b, const GeneticParameters& parameters);

}  // namespace concave_distance
