#pragma once

#include <Eigen/Core>

#include "concave_distance/mesh/surface/round_shape.h"
#include "triangle_distance.h"

namespace concave_distance {

/// Says where the signed distance to a round solid is least, in the shape's frame.
struct LowestPoint {
  double value;  ///< metres, negative inside
  Eigen::Vector3d point;
};

/// Error of the values below, relative to the largest magnitude of a coordinate and the size of the shape.
inline constexpr double kRoundDistanceError = 0x1.0p-47;  // 32 machine epsilons

/// On the segment from p to q: the signed distance is convex, so that its slope changes sign once. Closed for
/// a sphere, else some 20 slopes. Allocates nothing.
LowestPoint lowestOnSegment(const RoundShape& shape, const Eigen::Vector3d& p, const Eigen::Vector3d& q);

/// On a triangle, one without area too: the least over the whole plane, which lies in the plane of symmetry
/// through the axis, where that is inside, else the least over the edges. Right where the least is a segment
/// or a disc: that either holds the point found or crosses an edge.
LowestPoint lowestOnTriangle(const RoundShape& shape, const TrianglePoints& triangle);

/// No point of a triangle is lower: from the tangent plane at its middle. A few nanoseconds.
double lowerBoundOnTriangle(const RoundShape& shape, const TrianglePoints& triangle);

}  // namespace concave_distance
