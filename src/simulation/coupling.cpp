#include "coupling.h"

#include "base/cross_matrix.h"

namespace concave_distance::detail {
Matrix6d jacobianAt(const Eigen::Isometry3d& world_from_frame, const Eigen::Vector3d& centre) {
  const Eigen::Matrix3d axes = world_from_frame.linear().transpose();
  Matrix6d jacobian = Matrix6d::Zero();
  jacobian.topLeftCorner<3, 3>() = axes;
  jacobian.topRightCorner<3, 3>() = -axes * crossMatrix(world_from_frame.translation() - centre);
  jacobian.bottomRightCorner<3, 3>() = axes;
  return jacobian;
}

Vector6d twistBetween(const Eigen::Isometry3d& world_from_a, const FrameMotion& a, const FrameMotion& b) {
  const Eigen::Vector3d origin = world_from_a.translation();
  const Eigen::Matrix3d axes = world_from_a.linear().transpose();
  Vector6d twist;
  twist << axes * (b.velocityAt(origin) - a.velocityAt(origin)), axes * (b.twist - a.twist).tail<3>();
  return twist;
}

ContactLinearisation linearisationOf(const CompliantDrive& drive, const Eigen::Vector3d& point_in_target) {
  ContactLinearisation linearisation;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d direction = Eigen::Vector3d::Unit(axis);
    addDirection(drive.stiffness[axis], direction, point_in_target, linearisation.stiffness);
    addDirection(drive.damping[axis], direction, point_in_target, linearisation.damping);
    linearisation.stiffness(3 + axis, 3 + axis) += drive.rotational_stiffness[axis];
    linearisation.damping(3 + axis, 3 + axis) += drive.rotational_damping[axis];
  }
  mirrorUpper(linearisation.stiffness);
  mirrorUpper(linearisation.damping);
  return linearisation;
}

}  // namespace concave_distance::detail
