#pragma once

#include <vector>

#include "edge_fan.h"
#include "surface_units.h"

namespace concave_distance::detail {

/// The cell of space on each side of each face. Sides that face each other around an edge of their unit share
/// a cell, as do both sides of a face at a free edge. Faces that meet without a common edge do not separate
/// cells. A cell is named by one of its sides. O(n log n).
std::vector<FaceSide> findCells(const std::vector<Eigen::Vector3d>& vertices, const FaceTable& table,
                                const EdgeTable& edges, const SurfaceUnits& units);

}  // namespace concave_distance::detail
