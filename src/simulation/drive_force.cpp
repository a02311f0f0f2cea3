#include "drive_force.h"

#include <cmath>

#include "base/cross_matrix.h"

namespace concave_distance {
namespace {

Eigen::Vector3d rotationVector(const Eigen::Matrix3d& rotation) {
  Eigen::Quaterniond quaternion(rotation);
  if (quaternion.w() < 0.0) quaternion.coeffs() = -quaternion.coeffs();
  const Eigen::AngleAxisd turn(quaternion);
  return turn.angle() * turn.axis();
}

// J^-T of the left Jacobian of the rotation vector: with exp(phi) turned by dtheta, dphi = J^-1 dtheta, so a
// potential of phi has the torque -J^-T grad.
Eigen::Vector3d inverseTransposedJacobian(const Eigen::Vector3d& phi, const Eigen::Vector3d& gradient) {
  constexpr double kSmallAngle = 1e-4;
  const double angle = phi.norm();
  // 1/angle^2 - (1 + cos) / (2 angle sin), whose series begins 1/12 + angle^2/720.
  const double factor =
      angle < kSmallAngle ? 1.0 / 12.0
                          : 1.0 / (angle * angle) - (1.0 + std::cos(angle)) / (2.0 * angle * std::sin(angle));
  const Eigen::Matrix3d cross = crossMatrix(phi);
  return gradient + 0.5 * cross * gradient + factor * cross * cross * gradient;
}

}  // namespace

DriveForce driveForce(const CompliantDrive& drive, const PosePath& target, double time, double inside,
                      const RigidBody& body, const RigidBodyState& state) {
  const Eigen::Isometry3d world_from_drive = body.worldFromBody(state) * drive.body_from_drive;
  const Eigen::Isometry3d world_from_target = target.poseAt(time);
  const FrameTwist target_twist = target.twistAt(inside);
  const Eigen::Matrix3d& axes = world_from_target.linear();
  const Eigen::Vector3d point = world_from_drive.translation();
  const Eigen::Vector3d angular_velocity = body.angularVelocity(state);
  const Eigen::Vector3d target_velocity = target_twist.at(point - world_from_target.translation());
  const Eigen::Vector3d velocity = state.velocity + angular_velocity.cross(point - state.centre);

  const Eigen::Vector3d stretch = axes.transpose() * (world_from_target.translation() - point);
  const Eigen::Vector3d slip = axes.transpose() * (target_velocity - velocity);
  const Eigen::Vector3d phi = rotationVector(axes.transpose() * world_from_drive.linear());
  const Eigen::Vector3d turn_slip = axes.transpose() * (target_twist.angular - angular_velocity);

  const Eigen::Vector3d force =
      axes * (drive.stiffness.cwiseProduct(stretch) + drive.damping.cwiseProduct(slip));
  const Eigen::Vector3d torque =
      axes * (drive.rotational_damping.cwiseProduct(turn_slip) -
              inverseTransposedJacobian(phi, drive.rotational_stiffness.cwiseProduct(phi)));
  DriveForce result;
  result.on_body.force = force;
  result.on_body.torque = torque + (point - state.centre).cross(force);
  result.spring_energy = 0.5 * (stretch.dot(drive.stiffness.cwiseProduct(stretch)) +
                                phi.dot(drive.rotational_stiffness.cwiseProduct(phi)));
  result.loss = slip.dot(drive.damping.cwiseProduct(slip)) +
                turn_slip.dot(drive.rotational_damping.cwiseProduct(turn_slip));
  result.power = force.dot(target_velocity) + torque.dot(target_twist.angular);
  return result;
}

}  // namespace concave_distance
