#pragma once

#include "distance/kernels/surface_walk.h"

namespace concave_distance {

/// Returns the closest point of a body's whole original surface to `target` (body frame): branch and bound
/// over its tree, exact up to pointTriangleDistance's error. `hint` is a triangle to start the bound from.
/// Typically O(log n), allocates nothing.
SurfacePoint closestPoint(const BodyMesh& body, const Eigen::Vector3d& target, TriangleIndex hint);

}  // namespace concave_distance
