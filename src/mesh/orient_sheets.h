#pragma once

#include <vector>

#include "concave_distance/mesh/surface_mesh.h"

namespace concave_distance::detail {

/// Turns triangles of sheets (corners 1 and 2 change places) until the two of every edge that has just two
/// agree, as far as the sheet is orientable; an edge of more triangles passes no winding on. Each set of
/// triangles connected in this way keeps the winding that most of them have. Returns how many were turned.
/// O(n log n).
std::size_t orientSheets(std::vector<TriangleNodes>& triangles, const std::vector<bool>& is_sheet);

}  // namespace concave_distance::detail
