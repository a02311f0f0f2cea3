#pragma once

#include <cstdint>
#include <vector>

#include "edge_fan.h"
#include "surface_units.h"

namespace concave_distance::detail {

/// The cell of space on each side of each face: sides that look at each other around an edge of their unit
/// have one cell, as have both sides of a face at a free edge. What meets without sharing an edge does not
/// part cells. Cells are named by one of their sides. O(n log n).
std::vector<FaceSide> findCells(const std::vector<Eigen::Vector3d>& vertices, const FaceTable& table,
                                const EdgeTable& edges, const SurfaceUnits& units);

}  // namespace concave_distance::detail
