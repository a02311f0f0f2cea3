#pragma once

#include <Eigen/Core>
#include <array>

#include "concave_distance/mesh/body_mesh.h"

namespace concave_distance::detail {

/// Bounds how deep the points of a triangle lie below the surface of a body that they are inside of. All in
/// the body's frame.
class DepthWalls {
 public:
  /// @param slack metres, what bounds may be wrong by
  void begin(const BodyMesh& body, double slack);

  /// Returns values at the corners of a linear function that no depth on the triangle is above: the heights
  /// below the wall's plane where the whole triangle has the surface before that plane, as below a flat
  /// surface of many triangles; else the distances from the wall alone, because a distance to a convex set is
  /// convex.
  Eigen::Vector3d ceiling(const std::array<Eigen::Vector3d, 3>& corners, TriangleIndex wall) const;

 private:
  /// Returns whether no point of the triangle is in the body: it meets no surface, and a corner is outside.
  bool isOutside(const std::array<Eigen::Vector3d, 3>& triangle) const;

  const BodyMesh* body_ = nullptr;
  double slack_ = 0.0;
};

}  // namespace concave_distance::detail
