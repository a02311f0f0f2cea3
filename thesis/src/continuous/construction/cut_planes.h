#pragma once

#include <vector>

#include "hull_constraints.h"
#include "solid_facets.h"

namespace concave_distance {

/// Planes that are worth cutting a solid along, best first: each contains reflex edges (of more than 180
/// degrees inside the solid, bent by more than `tolerance`, metres). Candidates are the planes of the facets
/// at reflex edges and the planes through two reflex edges with a common vertex; a plane is better the more
/// length of reflex edges lies in it and the less it cuts through others. Empty when there is no reflex edge.
std::vector<CutPlane> cutPlanes(const SolidFacets& solid, double tolerance);

}  // namespace concave_distance
