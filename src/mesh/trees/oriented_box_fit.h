#pragma once

#include "bounding_volume_hierarchy.h"

namespace concave_distance::detail {

/// The corners of some triangles, three to a triangle.
struct CornerRange {
  const Eigen::Vector3d* begin;
  const Eigen::Vector3d* end;
};

/// Returns an oriented box around the corners, along the axes of the body frame, the principal axes of the
/// triangles' area, or the largest triangle's plane with its longest edge: those that give the least surface
/// area (doc/hierarchy.md compares them). Halves are not widened.
OrientedBox fitOrientedBox(const CornerRange& corners);

}  // namespace concave_distance::detail
