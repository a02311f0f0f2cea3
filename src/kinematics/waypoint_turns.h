#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "motion_paths.h"

namespace concave_distance::detail {

using Quaternions = std::vector<Eigen::Quaterniond, Eigen::aligned_allocator<Eigen::Quaterniond>>;

/// Adds the curves and turns of poses that run straight and turn by slerp. Returns the two elements that make
/// them, to be added in this order.
std::array<PathElement, 2> addPoses(const std::vector<Eigen::Vector3d>& positions,
                                    const Quaternions& rotations, const Eigen::Isometry3d& before,
                                    MotionPaths& paths);

}  // namespace concave_distance::detail
