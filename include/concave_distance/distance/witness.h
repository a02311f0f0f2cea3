#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "concave_distance/base/indices.h"

namespace concave_distance {

/// Says where on a triangle a witness lies.
enum class Feature : std::uint8_t { Vertex0, Vertex1, Vertex2, Edge0, Edge1, Edge2, Face };

/// Original triangles of the two bodies.
struct TrianglePair {
  TriangleIndex a;
  TriangleIndex b;
};

/// A pair of witness points on the original surfaces. Both points in body A's frame.
struct WitnessPair {
  /// The distance is that of the two points before they were moved from local coordinates to A's origin: what
  /// the points themselves give, but for the rounding of their coordinates.
  double squared_distance = 0.0;
  Eigen::Vector3d point_a_in_a = Eigen::Vector3d::Zero();
  Eigen::Vector3d point_b_in_a = Eigen::Vector3d::Zero();
  TriangleIndex triangle_a;  ///< original triangles that carry the points
  TriangleIndex triangle_b;
  Feature feature_a = Feature::Face;
  Feature feature_b = Feature::Face;
};

}  // namespace concave_distance
