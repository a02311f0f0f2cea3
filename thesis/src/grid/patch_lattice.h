#pragma once

#include <cstdint>
#include <vector>

#include "mesh/surface/editable_mesh.h"
#include "mesh/surface/flat_patches.h"
#include "patch_triangulation.h"

namespace concave_distance::detail {

/// A place in a patch's plane coordinates, and the triangle it lies in now.
struct LatticePoint {
  std::uint32_t triangle;
  Eigen::Vector2d place;
};

/// Points of a triangular lattice fitted to a patch, not too near to its border. A point on an edge may come
/// twice.
/// @param triangles those of the patch now
void findLatticePoints(const EditableMesh& mesh, const PatchTriangulation& triangulation,
                       const std::vector<std::uint32_t>& triangles, const PatchFrame& frame,
                       double max_edge_length, std::vector<LatticePoint>& points);

}  // namespace concave_distance::detail
