#pragma once

#include <cstddef>
#include <vector>

#include "concave_distance/mesh/surface_mesh.h"

namespace concave_distance::detail {

struct SettledFaces {
  std::size_t duplicates = 0;   ///< triangles dropped because others have the same corners
  std::size_t inner_walls = 0;  ///< triangles dropped between solids that share them
  std::size_t turned = 0;
};

/// Makes the triangles the surface of the union of the solids they bound (resolveShells): drops walls between
/// two solids and triangles that are there more often than the surface needs and, with `orient`, turns solids
/// outwards, cavities inwards and each sheet to the winding that most of it has. The rest keeps its order.
/// O(n log n), and O(n) for each solid within another one's bounding box.
SettledFaces settleFaces(const std::vector<Eigen::Vector3d>& vertices, std::vector<TriangleNodes>& triangles,
                         bool orient);

}  // namespace concave_distance::detail
