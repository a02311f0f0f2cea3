#pragma once

#include <vector>

#include "concave_distance/mesh/bounding_volume_hierarchy.h"

namespace concave_distance::detail {

/// The corners of some triangles, three to a triangle.
struct CornerRange {
  const Eigen::Vector3d* begin;
  const Eigen::Vector3d* end;
};

/// A small oriented box around the corners: the one of least surface area among the frame's axes, the
/// principal axes of the triangles' area, and the largest triangle's plane with its longest edge. Halves are
/// not widened.
OrientedBox fitOrientedBox(const CornerRange& corners);

}  // namespace concave_distance::detail
