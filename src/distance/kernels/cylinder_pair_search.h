#pragma once

#include "round_pair_distance.h"

namespace concave_distance::detail {

/// Two cylinders, however they lie: slower than support points and as exact. Cylinders apart are as far apart
/// as a disc at an end of one is from the other solid, or as their sides where the axes cross as seen along
/// the way between them. The signed distance is convex, so that a search over each disc finds its least value
/// to rounding. The lower bound is the greatest separation by a plane among the directions that are normal to
/// a face, a side or a rim of both at the points found: taken from the features and not from the difference
/// of the points, which says little where the cylinders nearly touch. Both are within kRoundDistanceError.
RoundPairDistance searchCylinders(const RoundShape& a, const RoundShape& b,
                                  const Eigen::Isometry3d& a_from_b);

}  // namespace concave_distance::detail
