#pragma once

#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance::detail {

/// Turns triangles of sheets (swaps corners 1 and 2) until the two at every edge of exactly two agree, as far
/// as the sheet is orientable; windings are not compared across edges of more triangles. Each set of
/// connected triangles keeps the winding of its majority. Returns how many were turned. O(n log n).
std::size_t orientSheets(std::vector<TriangleNodes>& triangles, const std::vector<bool>& is_sheet);

}  // namespace concave_distance::detail
