#pragma once

#include <cstddef>
#include <vector>

#include "concave_distance/mesh/surface_mesh.h"

namespace concave_distance::detail {

struct DissolvedTriangles {
  std::size_t flat = 0;   ///< of the given triangles, how many had no area
  std::size_t split = 0;  ///< triangles split in two
};

/// Takes away triangles with no area beyond what the rounding of their edge vectors may feign: the height over
/// the longest edge is at most four units of rounding of that edge. Where one closes the gap between a long
/// edge and the short ones beside it, the triangles at the long edge are split at its corner instead, so that
/// what was closed stays closed; no point of the surface moves by more than that height. O(n log n).
DissolvedTriangles dissolveFlatTriangles(const std::vector<Eigen::Vector3d>& vertices,
                                         std::vector<TriangleNodes>& triangles);

}  // namespace concave_distance::detail
