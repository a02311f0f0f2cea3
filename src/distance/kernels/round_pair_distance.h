#pragma once

#include <Eigen/Geometry>

#include "concave_distance/mesh/surface/round_shape.h"

namespace concave_distance {

/// Distance of two round solids, which have one local minimum. Points in A's shape frame.
struct RoundPairDistance {
  double distance = 0.0;     ///< metres; 0 where they overlap
  double lower_bound = 0.0;  ///< proven but for kRoundDistanceError
  bool overlap = false;
  Eigen::Vector3d point_a = Eigen::Vector3d::Zero();
  Eigen::Vector3d point_b = Eigen::Vector3d::Zero();
};

/// Closed forms and lowestOnSegment() where one is a sphere or a capsule. Two cylinders: the points of their
/// difference nearest to the origin (Gilbert, Johnson and Keerthi 1988), until the plane through them that
/// separates the solids is as far as they are; where rounding hides that, searchCylinders(). Distance and
/// lower bound are wrong by at most kRoundDistanceError of the distance of the centres and both reaches.
/// @param a_from_b of the shapes' frames
RoundPairDistance roundPairDistance(const RoundShape& a, const RoundShape& b,
                                    const Eigen::Isometry3d& a_from_b);

}  // namespace concave_distance
