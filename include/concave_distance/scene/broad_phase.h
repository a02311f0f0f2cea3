#pragma once

#include <Eigen/Geometry>

#include "concave_distance/mesh/body_mesh.h"
#include "concave_distance/mesh/surface/surface_mesh.h"

namespace concave_distance {

/// A box and a sphere that hold a body, in its own frame, metres, rounded outwards.
struct BodyBounds {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< of both
  Eigen::Vector3d half_extents = Eigen::Vector3d::Zero();
  double radius = 0.0;
};

/// O(vertices).
BodyBounds boundsOf(const SurfaceMesh& surface);
/// Bounds the body's shape where it has one, else its mesh.
BodyBounds boundsOf(const BodyMesh& body);

/// A distance that two bodies are never nearer than, metres: a pair whose bound exceeds its cutoff need not
/// be searched. The best of the two spheres, of both boxes along each other's axes taken together, and of the
/// nine cross products of the axes (separating axes: Gottschalk, Lin and Manocha 1996). Rounded down:
/// rounding errors are subtracted, and `a_from_b` is taken as it is given, orthonormal or nearly so. 0 when
/// the bounds meet, and for a pose that is not finite. Some 0.2 us; allocates nothing.
/// @param margin metres that both bodies together are moved out by
double distanceLowerBound(const BodyBounds& a, const BodyBounds& b, const Eigen::Isometry3d& a_from_b,
                          double margin = 0.0);

}  // namespace concave_distance
