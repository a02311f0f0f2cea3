#pragma once

#include <cstdint>

#include "bounding_volume_hierarchy.h"

namespace concave_distance::detail {

/// The corners of some triangles, three to a triangle.
struct CornerRange {
  const Eigen::Vector3d* begin;
  const Eigen::Vector3d* end;
};

enum class BoxAxes : std::uint8_t {
  Frame,      ///< those of the body frame
  Principal,  ///< the principal axes of the triangles' area
  Fitted      ///< those of the two, and of the largest triangle's plane with its longest edge, that give the
              ///< least surface area
};

/// An oriented box around the corners. Halves are not widened. What the hierarchy has are the fitted ones;
/// the others are what they are compared with (doc/hierarchy.md).
OrientedBox fitOrientedBox(const CornerRange& corners, BoxAxes axes = BoxAxes::Fitted);

}  // namespace concave_distance::detail
