#pragma once

#include <Eigen/Geometry>

#include "concave_distance/interference/interference.h"

namespace concave_distance::detail {

/// The region of overlap of two round solids at least one of which is a sphere or a capsule: its surface is
/// taken as a height over the plane across the way out, in polar coordinates about the middle of the overlap,
/// and the depth below the other solid's surface is integrated over it. Allocates nothing but for the result.
/// False where the overlap is not of that kind: two cylinders, a solid within the other, or one so deep that
/// it reaches round the sphere or capsule.
bool findRoundPairOverlap(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                          Interference& result);

}  // namespace concave_distance::detail
