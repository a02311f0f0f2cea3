#pragma once

#include <cstdint>
#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"
#include "mesh/surface/flat_patches.h"
#include "patch_triangulation.h"

namespace concave_distance::detail {

/// Finds the original triangle of a patch under a point of its plane, and the point of the surface there.
/// Refers to its arguments. O(1) a query where triangles are of like size.
class PatchLocator {
 public:
  PatchLocator(const SurfaceMesh& surface, const PatchFrame& frame,
               const std::vector<std::uint32_t>& triangles);
  GridPoint find(const Eigen::Vector2d& place) const;

 private:
  std::size_t binOf(double coordinate, int axis) const;

  const SurfaceMesh& surface_;
  const PatchFrame& frame_;
  const std::vector<std::uint32_t>& triangles_;
  Eigen::AlignedBox2d box_;
  std::size_t bins_ = 1;  ///< along each axis
  std::vector<std::vector<std::uint32_t>> members_;
};

}  // namespace concave_distance::detail
