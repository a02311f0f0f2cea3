#pragma once

#include <cstddef>
#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance::detail {

struct SettledFaces {
  std::size_t duplicates = 0;   ///< triangles dropped because others have the same corners
  std::size_t inner_walls = 0;  ///< triangles dropped that two solids share
  std::size_t turned = 0;
};

/// Reduces the triangles to the surface of the union of the solids they bound (resolveShells): drops walls
/// between two solids and superfluous duplicates and, with `orient`, turns solids outwards, cavities inwards
/// and each sheet to the winding of its majority. Keeps the order of the rest. O(n log n), and
/// findCavities() for solids within others.
SettledFaces settleFaces(const std::vector<Eigen::Vector3d>& vertices, std::vector<TriangleNodes>& triangles,
                         bool orient);

}  // namespace concave_distance::detail
