#pragma once

#include <cstddef>
#include <vector>

#include "concave_distance/mesh/surface_mesh.h"

namespace concave_distance::detail {

/// Drops triangles with no area beyond what the rounding of their edge vectors may feign: the height over the
/// longest edge is at most four units of rounding of that edge. Returns how many fell.
std::size_t dropWithoutArea(const std::vector<Eigen::Vector3d>& vertices,
                            std::vector<TriangleNodes>& triangles);

/// Keeps the vertices that a triangle uses, in their order; returns how many fell.
std::size_t dropUnused(std::vector<Eigen::Vector3d>& vertices, std::vector<TriangleNodes>& triangles);

}  // namespace concave_distance::detail
