#pragma once

#include <vector>

#include "boundary_components.h"
#include "concave_distance/interference/interference.h"

namespace concave_distance::detail {

/// Adds a component's surface, cavities included, as facets in A's frame: whole triangles as they are, the
/// inside part of a crossed one as a fan around the middle of its boundary. Where that part is not convex
/// some of the fan's triangles lie partly outside; signs make the sum right.
void appendFacets(WorkingFrame& frame, const SurfacePieces (&pieces)[2], const BoundaryComponents& components,
                  const BoundaryComponent& region, std::vector<OverlapFacet>& facets);

}  // namespace concave_distance::detail
