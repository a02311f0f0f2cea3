#include "rigid_pose.h"

#include "base/constants.h"

namespace concave_distance {

std::optional<Eigen::Isometry3d> rigidPose(const Eigen::Isometry3d& pose) {
  const Eigen::Matrix3d rotation = pose.linear();
  if (!pose.matrix().allFinite() || pose.translation().cwiseAbs().maxCoeff() > kLargestCoordinate ||
      rotation.determinant() <= 0.0 ||
      !((rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <=
        kUnitTolerance)) {
    return std::nullopt;
  }
  Eigen::Isometry3d rigid = Eigen::Isometry3d::Identity();
  rigid.linear() = Eigen::Quaterniond(rotation).normalized().toRotationMatrix();
  rigid.translation() = pose.translation();
  return rigid;
}

}  // namespace concave_distance
