#pragma once

#include "triangle_distance.h"

namespace concave_distance::detail {

struct TriangleCrossing {
  bool found = false;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< on both
  Feature feature_a = Feature::Face;
  Feature feature_b = Feature::Face;
};

/// Finds a point where an edge of one triangle runs through the inside of the other, in double-double
/// arithmetic: about a microsecond. Contacts that only touch (a vertex in a face, crossing edges, coplanar
/// overlap) are left to the features' distances, which are then within rounding of 0.
TriangleCrossing findCrossing(const TrianglePoints& a, const TrianglePoints& b);

}  // namespace concave_distance::detail
