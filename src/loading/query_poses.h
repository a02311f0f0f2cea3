#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "concave_distance/scene/simulation_settings.h"

namespace concave_distance {

/// A line of poses.csv as it stands there: pose of B in A's frame.
struct QueryPose {
  double time = 0.0;  ///< seconds
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector4d quaternion = Eigen::Vector4d::Zero();  ///< x, y, z, w, not normalised
  std::optional<Eigen::Matrix3d> rotation;               ///< in place of the quaternion
};

/// Header of poses whose rotations are matrices, row by row: nothing is rounded on their way.
inline constexpr const char* kMatrixPoseHeader = "t,x,y,z,r11,r12,r13,r21,r22,r23,r31,r32,r33";

/// Reads a file with the header t,x,y,z,qx,qy,qz,qw, or kMatrixPoseHeader, and one query a line. Empty lines
/// are passed over, spaces around a value too; numbers that are not finite are left to poseOf().
/// @throws Error naming file and line
std::vector<QueryPose> readQueryPoses(const std::string& path);

/// Returns the content of a file below kMatrixPoseHeader, which reads back to the last bit.
std::string matrixPosesText(const std::vector<TimedPose>& poses);

/// The same as a path. @throws Error naming the file for what is no pose, times that do not ascend, no pose
std::vector<TimedPose> readPosePath(const std::string& path);

/// The pose with its quaternion normalised; empty when a number is not finite, the quaternion's norm is not
/// within 1e-3 of 1, or the matrix is not a rotation within that.
std::optional<Eigen::Isometry3d> poseOf(const QueryPose& query);

}  // namespace concave_distance
