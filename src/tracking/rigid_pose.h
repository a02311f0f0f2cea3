#pragma once

#include <Eigen/Geometry>
#include <optional>

namespace concave_distance {

/// Returns the nearest rotation to a pose's linear part when that is orthonormal within 1e-3 and all is
/// finite, else empty. Ros poses come with quaternions that are unit only up to rounding.
std::optional<Eigen::Isometry3d> rigidPose(const Eigen::Isometry3d& pose);

}  // namespace concave_distance
