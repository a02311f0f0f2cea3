#pragma once

#include <Eigen/Geometry>

namespace concave_distance::test {

/// A pose as a user states it; the quaternion (x, y, z, w) need not be of unit norm.
struct GivenPose {
  Eigen::Vector4d quaternion{0.0, 0.0, 0.0, 1.0};
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  /// As the library is handed it, with the rounding of double precision.
  Eigen::Isometry3d isometry() const {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = Eigen::Quaterniond(quaternion).normalized().toRotationMatrix();
    pose.translation() = translation;
    return pose;
  }
};

inline GivenPose givenPose(const Eigen::Quaterniond& rotation, const Eigen::Vector3d& translation) {
  return {rotation.coeffs(), translation};
}

}  // namespace concave_distance::test
