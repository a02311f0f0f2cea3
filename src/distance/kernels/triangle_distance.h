#pragma once

#include <Eigen/Core>
#include <array>

#include "concave_distance/distance/witness.h"

namespace concave_distance {

using TrianglePoints = std::array<Eigen::Vector3d, 3>;

struct TrianglePairDistance {
  double squared_distance;  ///< = (point_b - point_a).squaredNorm(); 0 when the triangles meet
  Eigen::Vector3d point_a;  ///< on a, the caller's frame
  Eigen::Vector3d point_b;
  Feature feature_a;
  Feature feature_b;
};

/// Error bounds of the two functions below, relative to the largest magnitude of a coordinate of either
/// argument (recentre where that is much larger than the triangles and their gap): of the distance, and of
/// how far a witness may lie off the feature that is named for it. Worst errors observed: doc/numerics.md.
inline constexpr double kTriangleDistanceError = 0x1.0p-47;  // 32 machine epsilons
inline constexpr double kTriangleWitnessError = 0x1.0p-50;   // 4 machine epsilons

/// Distance of two triangles with a pair of witness points, right for triangles that are segments or points,
/// for parallel, coplanar, touching and crossing ones. Allocates nothing, never fails on finite input.
/// Error: kTriangleDistanceError, kTriangleWitnessError. About 0.1 us for triangles apart, 0.5 us for such as
/// touch or cross.
TrianglePairDistance triangleDistance(const TrianglePoints& a, const TrianglePoints& b);

struct PointTriangleDistance {
  double squared_distance;
  Eigen::Vector3d point;  ///< closest on the triangle
  Feature feature;
};

/// Closest point of a triangle (Ericson 2005, sec. 5.1.5, with degenerate triangles as segments or points).
PointTriangleDistance pointTriangleDistance(const Eigen::Vector3d& point, const TrianglePoints& triangle);

}  // namespace concave_distance
