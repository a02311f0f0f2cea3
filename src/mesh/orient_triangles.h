#pragma once

#include <vector>

#include "concave_distance/mesh/surface_mesh.h"

namespace concave_distance::detail {

/// Turns triangles (corners 1 and 2 change places) until the two triangles of every edge that has just two
/// agree, as far as the surface is orientable; an edge of more triangles passes no winding on. A set of
/// triangles connected in this way that encloses a volume is then turned outwards, or inwards when it lies in
/// an odd number of other closed sets (the wall of a hollow); an open set keeps the winding of most of its
/// triangles. Returns how many triangles were turned. Winding numbers: van Oosterom and Strackee 1983.
/// O(n log n), and O(n) more for each set inside another one's bounding box.
std::size_t orientTriangles(const std::vector<Eigen::Vector3d>& vertices,
                            std::vector<TriangleNodes>& triangles);

}  // namespace concave_distance::detail
