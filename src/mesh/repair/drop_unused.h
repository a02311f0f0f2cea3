#pragma once

#include <cstddef>
#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance::detail {

/// Keeps the vertices that a triangle uses, in their order; returns how many were dropped.
std::size_t dropUnused(std::vector<Eigen::Vector3d>& vertices, std::vector<TriangleNodes>& triangles);

}  // namespace concave_distance::detail
