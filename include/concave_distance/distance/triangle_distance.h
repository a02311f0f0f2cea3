#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace concave_distance {

using TrianglePoints = std::array<Eigen::Vector3d, 3>;

/// Where on a triangle a witness lies.
enum class Feature : std::uint8_t { Vertex0, Vertex1, Vertex2, Edge0, Edge1, Edge2, Face };

struct TrianglePairDistance {
  double squared_distance;  ///< = (point_b - point_a).squaredNorm(); 0 when the triangles meet
  Eigen::Vector3d point_a;  ///< on a, the caller's frame
  Eigen::Vector3d point_b;
  Feature feature_a;
  Feature feature_b;
};

/// Distance of two triangles with a pair of witness points, right for triangles that are segments or points,
/// for parallel, coplanar, touching and crossing ones. Allocates nothing, never fails on finite input.
/// Error bound: stated in the source and in doc/numerics.md, in units of the larger coordinate's magnitude
/// after the caller has recentred.
TrianglePairDistance triangleDistance(const TrianglePoints& a, const TrianglePoints& b);

struct PointTriangleDistance {
  double squared_distance;
  Eigen::Vector3d point;  ///< closest on the triangle
  Feature feature;
};

/// Closest point of a triangle (Ericson 2005, sec. 5.1.5, with degenerate triangles as segments or points).
PointTriangleDistance pointTriangleDistance(const Eigen::Vector3d& point, const TrianglePoints& triangle);

}  // namespace concave_distance
