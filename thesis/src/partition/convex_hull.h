#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "convex_piece.h"

namespace concave_distance {

/// The convex hull of points (metres), computed exactly (CGAL): the root of a constraint tree (Carretero,
/// sec. 2.1.1). @throws Error (naming `where`) when all points lie in one plane
ConvexPiece convexHull(const std::vector<Eigen::Vector3d>& points, const std::string& where);

}  // namespace concave_distance
