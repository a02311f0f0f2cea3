#pragma once

#include <cstddef>
#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance::detail {

struct DissolvedTriangles {
  std::size_t flat = 0;   ///< number of given triangles without area
  std::size_t split = 0;  ///< triangles split in two
};

/// Removes triangles without area beyond rounding: with a height over the longest edge of at most four units
/// of rounding of that edge. If such a triangle closes the gap between a long edge and two short ones, the
/// triangles at the long edge are split at its corner, so that a closed surface stays closed. No point of the
/// surface moves by more than that height. O(n log n).
DissolvedTriangles dissolveFlatTriangles(const std::vector<Eigen::Vector3d>& vertices,
                                         std::vector<TriangleNodes>& triangles);

}  // namespace concave_distance::detail
