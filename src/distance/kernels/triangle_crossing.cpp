#include "triangle_crossing.h"

#include "base/double_double.h"

namespace concave_distance::detail {
namespace {

/// A triangle relative to a common origin, exact up to 2^-106.
struct WideTriangle {
  std::array<WideVector, 3> corners;
  std::array<WideVector, 3> edges;  ///< from corner k to corner (k + 1) % 3
  WideVector normal;                ///< not unit
};

WideTriangle widen(const TrianglePoints& triangle, const Eigen::Vector3d& origin) {
  WideTriangle wide;
  for (std::size_t k = 0; k < 3; ++k) {
    wide.corners[k] = wideDifference(triangle[k], origin);
    wide.edges[k] = wideDifference(triangle[(k + 1) % 3], triangle[k]);
  }
  wide.normal = cross(wide.edges[0], wide.edges[1]);
  return wide;
}

bool contains(const WideTriangle& triangle, const WideVector& point_in_plane) {
  for (std::size_t k = 0; k < 3; ++k) {
    const WideVector inwards = cross(triangle.normal, triangle.edges[k]);
    if (dot(inwards, point_in_plane - triangle.corners[k]).sign() < 0) return false;
  }
  return true;
}

/// Which edge of `edged` runs through the inside of `faced`, and where; -1 when none does.
int piercingEdge(const WideTriangle& edged, const WideTriangle& faced, WideVector& at) {
  std::array<DoubleDouble, 3> heights;
  std::array<int, 3> sides{};
  for (std::size_t k = 0; k < 3; ++k) {
    heights[k] = dot(faced.normal, edged.corners[k] - faced.corners[0]);
    sides[k] = heights[k].sign();
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    if (sides[k] * sides[next] >= 0) continue;
    at = advance(edged.corners[k], heights[k] / (heights[k] - heights[next]), edged.edges[k]);
    if (contains(faced, at)) return static_cast<int>(k);
  }
  return -1;
}

Feature edgeFeature(int edge) {
  return static_cast<Feature>(static_cast<int>(Feature::Edge0) + edge);
}

}  // namespace

TriangleCrossing findCrossing(const TrianglePoints& a, const TrianglePoints& b) {
  const Eigen::Vector3d& origin = a[0];
  const WideTriangle wide_a = widen(a, origin);
  const WideTriangle wide_b = widen(b, origin);
  TriangleCrossing crossing;
  WideVector at;
  if (const int edge = piercingEdge(wide_a, wide_b, at); edge >= 0) {
    crossing.feature_a = edgeFeature(edge);
  } else if (const int other = piercingEdge(wide_b, wide_a, at); other >= 0) {
    crossing.feature_b = edgeFeature(other);
  } else {
    return crossing;
  }
  crossing.found = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    crossing.point[axis] = (DoubleDouble{origin[axis], 0.0} + at[k]).value();
  }
  return crossing;
}

}  // namespace concave_distance::detail
