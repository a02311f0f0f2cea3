#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "concave_distance/mesh/surface/surface_mesh.h"
#include "support/exact_triangle_distance.h"
#include "support/given_pose.h"

/// The truth of a whole query: the distance of two surfaces at a pose, from all pairs of their triangles, by
/// formulas and in number types that the library does not use. Surfaces only: whether one body has swallowed
/// the other is not asked here.
namespace concave_distance::test {

/// Points of B in A's frame, relative to `centre`, without rounding to speak of: the quaternion is normalised
/// in 100 digits.
std::vector<ExactVector<Wide>> exactlyMoved(const std::vector<Eigen::Vector3d>& points, const GivenPose& pose,
                                            const Eigen::Vector3d& centre);

/// The distance of the surfaces in 100 digits. Every pair of triangles is looked at in `long double`; what
/// comes within 1e-9 of the scene's size of the least (the naive formulas' error is 2e-10 of it at worst) is
/// evaluated again. O(triangles_a * triangles_b).
Wide exactSurfaceDistance(const SurfaceMesh& a, const SurfaceMesh& b, const GivenPose& b_in_a);

/// Distance of a point from a surface, both in one frame, in 100 digits.
double surfaceOffset(const Eigen::Vector3d& point, const SurfaceMesh& surface);

}  // namespace concave_distance::test
