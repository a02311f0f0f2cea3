#include "simulation/drive_force.h"

#include <gtest/gtest.h>

namespace concave_distance::drive_force_test {
namespace {

RigidBody brick() {
  MassProperties properties;
  properties.centre_in_body = {0.1, -0.2, 0.3};
  properties.inertia = Eigen::Vector3d(0.2, 0.3, 0.4).asDiagonal();
  return RigidBody(properties, "brick");
}

CompliantDrive uneven() {
  CompliantDrive drive;
  drive.body_from_drive =
      Eigen::Translation3d(0.2, 0.1, 0.0) * Eigen::Quaterniond(0.9, 0.1, 0.2, -0.1).normalized();
  drive.stiffness = {100.0, 200.0, 50.0};
  drive.rotational_stiffness = {3.0, 7.0, 5.0};
  drive.target = {
      {0.0, Eigen::Translation3d(0.3, 0.2, 0.1) * Eigen::Quaterniond(0.8, -0.3, 0.4, 0.2).normalized()}};
  return drive;
}

// The spring's wrench is minus the gradient of its energy, in all six directions, for unequal axes too.
TEST(DriveForce, IsMinusTheGradientOfTheSpringEnergy) {
  const RigidBody body = brick();
  const CompliantDrive drive = uneven();
  const PosePath target(drive.target);
  const RigidBodyState state =
      body.stateAt(Eigen::Isometry3d::Identity(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero());
  const DriveForce force = driveForce(drive, target, 0.0, 0.0, body, state);
  const double h = 1e-6;
  for (int axis = 0; axis < 3; ++axis) {
    const auto energy_at = [&](double shift, double turn) {
      RigidBodyState moved = state;
      moved.centre += shift * Eigen::Vector3d::Unit(axis);
      moved.world_from_principal = Eigen::Quaterniond(Eigen::AngleAxisd(turn, Eigen::Vector3d::Unit(axis))) *
                                   moved.world_from_principal;
      return driveForce(drive, target, 0.0, 0.0, body, moved).spring_energy;
    };
    // Central differences: error h^2 times third derivatives (some 100), and rounding 1e-16 E / h.
    EXPECT_NEAR(force.on_body.force[axis], -(energy_at(h, 0) - energy_at(-h, 0)) / (2 * h), 1e-7);
    EXPECT_NEAR(force.on_body.torque[axis], -(energy_at(0, h) - energy_at(0, -h)) / (2 * h), 1e-7);
  }
}

TEST(DriveForce, DampingTakesAndAMovingTargetGives) {
  const RigidBody body = brick();
  CompliantDrive drive = uneven();
  drive.damping = {10.0, 5.0, 2.0};
  drive.rotational_damping = {0.3, 0.2, 0.1};
  TimedPose later = drive.target.front();
  later.time = 1.0;
  later.pose =
      Eigen::Translation3d(0.5, 0.1, -0.3) * later.pose * Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitY());
  drive.target.push_back(later);
  const PosePath target(drive.target);
  const RigidBodyState state =
      body.stateAt(Eigen::Isometry3d::Identity(), {0.2, -0.1, 0.4}, {0.5, 0.3, -0.2});
  const double time = 0.4;
  const DriveForce now = driveForce(drive, target, time, time, body, state);
  EXPECT_GT(now.loss, 0.0);
  // Power on the body + change of the spring's energy + loss = power of the target.
  const double h = 1e-6;
  const auto energy_at = [&](double t) {
    RigidBodyState moved = state;
    body.drift(t, moved);
    return driveForce(drive, target, time + t, time, body, moved).spring_energy;
  };
  const double into_spring = (energy_at(h) - energy_at(-h)) / (2 * h);
  const double into_body =
      now.on_body.force.dot(state.velocity) + now.on_body.torque.dot(body.angularVelocity(state));
  EXPECT_NEAR(into_body + into_spring + now.loss, now.power, 1e-6);
}

TEST(PosePath, GoesStraightBetweenItsPosesAndRestsOutside) {
  TimedPose first;
  first.time = 1.0;
  TimedPose second;
  second.time = 3.0;
  second.pose = Eigen::Translation3d(1.0, 0.0, 0.0) * Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitZ());
  const PosePath path({first, second});
  EXPECT_TRUE(path.poseAt(0.0).isApprox(first.pose));
  EXPECT_TRUE(path.poseAt(4.0).isApprox(second.pose));
  EXPECT_LT((path.poseAt(2.0).translation() - Eigen::Vector3d(0.5, 0.0, 0.0)).norm(), 1e-15);
  EXPECT_NEAR(Eigen::AngleAxisd(path.poseAt(2.0).linear()).angle(), 0.5, 1e-15);
  EXPECT_LT((path.twistAt(2.0).linear - Eigen::Vector3d(0.5, 0.0, 0.0)).norm(), 1e-15);
  EXPECT_LT((path.twistAt(2.0).angular - Eigen::Vector3d(0.0, 0.0, 0.5)).norm(), 1e-15);
  EXPECT_EQ(path.twistAt(0.5).linear.norm(), 0.0);
  EXPECT_EQ(path.twistAt(3.5).linear.norm(), 0.0);
  EXPECT_EQ(path.nextChange(0.0), 1.0);
  EXPECT_EQ(path.nextChange(1.0), 3.0);
  EXPECT_TRUE(std::isinf(path.nextChange(3.0)));
}

}  // namespace
}  // namespace concave_distance::drive_force_test
