#pragma once

#include <Eigen/Geometry>
#include <optional>

namespace concave_distance {

/// Returns the nearest rotation to a pose's linear part when that is orthonormal within 1e-3 and all is
/// finite, else empty. Ros poses come with quaternions that are unit only up to rounding.
std::optional<Eigen::Isometry3d> rigidPose(const Eigen::Isometry3d& pose);

/// Returns the largest displacement of any point of a box between two poses, metres: the norm of an affine
/// map is convex, so its maximum over a box is at a corner. Bounds the change of every distance.
double largestDisplacement(const Eigen::AlignedBox3d& box, const Eigen::Isometry3d& before,
                           const Eigen::Isometry3d& after);

}  // namespace concave_distance
