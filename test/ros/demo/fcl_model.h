#pragma once

#include <fcl/geometry/bvh/BVH_model.h>

#include <Eigen/Geometry>
#include <memory>
#include <string>

namespace concave_distance::demo {

using FclModel = fcl::BVHModel<fcl::OBBRSSd>;

/// FCL's model of a binary STL, read here byte by byte: an oracle that shares no code with the package.
/// Throws std::runtime_error when the file is no binary STL.
std::shared_ptr<const FclModel> loadFclModel(const std::string& path);

/// FCL's distance; 0 when the meshes touch or cross.
double fclDistance(const FclModel& a, const Eigen::Isometry3d& a_pose, const FclModel& b,
                   const Eigen::Isometry3d& b_pose);

}  // namespace concave_distance::demo
