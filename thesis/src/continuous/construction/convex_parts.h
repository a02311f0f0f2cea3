#pragma once

#include <cstdint>
#include <vector>

#include "cut_planes.h"
#include "exact_solid.h"

namespace concave_distance {

struct ConvexParts {
  std::vector<SolidFacets> parts;  ///< each convex to the tolerance
  std::vector<CutPlane> cuts;
  bool used_vertical_walls = false;
};

/// Divides a solid into convex parts: cuts along the best of cutPlanes() as often as needed; what `cut_limit`
/// cuts leave is divided by CGAL's vertical walls. Parts thinner than `tolerance` (metres) are left out.
ConvexParts convexParts(const ExactSolid& solid, double tolerance, std::uint32_t cut_limit);

}  // namespace concave_distance
