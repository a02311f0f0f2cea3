#include "relative_motion.h"

#include <algorithm>

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

double largestDisplacement(const Eigen::AlignedBox3d& box, const Eigen::Isometry3d& before,
                           const Eigen::Isometry3d& after) {
  const Eigen::Matrix3d turn = after.linear() - before.linear();
  const Eigen::Vector3d shift = after.translation() - before.translation();
  double largest = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d point = box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner));
    largest = std::max(largest, (turn * point + shift).squaredNorm());
  }
  return std::sqrt(largest);
}

}  // namespace concave_distance
