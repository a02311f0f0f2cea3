#pragma once

#include "concave_distance/mesh/body_mesh.h"
#include "triangle_distance.h"

namespace concave_distance {

/// A point on a body's original surface, body frame.
struct SurfacePoint {
  TriangleIndex triangle;
  Feature feature = Feature::Face;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double squared_distance = 0.0;  ///< to the target of the walk
};

/// Walks over the surface from `start` to a local minimum of the distance to `target` (body frame): from
/// triangle to touching triangle, strictly closer each step. Stays on the shell it starts on. O(steps).
SurfacePoint walkTowards(const BodyMesh& body, TriangleIndex start, const Eigen::Vector3d& target);

/// Returns the three corners of an original triangle, body frame.
inline TrianglePoints trianglePoints(const SurfaceMesh& surface, TriangleIndex triangle) {
  return {surface.corner(triangle, 0), surface.corner(triangle, 1), surface.corner(triangle, 2)};
}

}  // namespace concave_distance
