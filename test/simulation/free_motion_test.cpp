#include <gtest/gtest.h>

#include <cmath>

#include "concave_distance/base/error.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "simulation/scene_builder.h"

namespace concave_distance::free_motion_test {
namespace {

using test::at;
using test::SceneBuilder;

SceneBuilder oneBody(double mass = 2.0) {
  SceneBuilder builder;
  builder.addBody("brick", makeBox({0.3, 0.2, 0.1}));
  builder.setFree("brick", mass);
  return builder;
}

TEST(Simulation, FreeFallIsExactForEveryStep) {
  SceneBuilder builder = oneBody();
  builder.settings.gravity = {0.0, 1.0, -9.0};
  builder.settings.largest_step = 0.1;
  builder.settings.bodies[0].velocity = {1.0, 0.0, 3.0};
  Simulation simulation = builder.simulation();
  ASSERT_EQ(simulation.advanceTo(2.0), SimulationStatus::Ok);
  EXPECT_EQ(simulation.time(), 2.0);
  EXPECT_LT((simulation.bodies()[0].centre - Eigen::Vector3d(2.0, 2.0, 6.0 - 18.0)).norm(), 1e-13);
  EXPECT_LT((simulation.bodies()[0].velocity - Eigen::Vector3d(1.0, 2.0, 3.0 - 18.0)).norm(), 1e-13);
  EXPECT_LT(std::abs(simulation.energy().balanceError()), 1e-12);
}

TEST(Simulation, WithoutForcesMomentumStaysToRoundingAndEnergyToTheSecondOrder) {
  double last = 0.0;
  for (const double step : {4e-3, 2e-3, 1e-3}) {
    SceneBuilder builder = oneBody();
    builder.settings.gravity.setZero();
    builder.settings.largest_step = step;
    builder.settings.step_fraction = 1.0;
    builder.settings.bodies[0].velocity = {1.0, 2.0, 3.0};
    builder.settings.bodies[0].angular_velocity = {0.3, 8.0, 0.2};
    Simulation simulation = builder.simulation();
    const Eigen::Vector3d momentum = simulation.momentum();
    const Eigen::Vector3d angular_momentum = simulation.angularMomentum();
    double error = 0.0;
    while (simulation.time() < 2.0) {
      simulation.step(2.0);
      error = std::max(error, std::abs(simulation.energy().balanceError()));
    }
    EXPECT_EQ(simulation.momentum(), momentum);
    // What is added up in every step is rounded: steps times epsilon times |x| |m v|.
    const double rounding = static_cast<double>(simulation.counters().steps) * 2.3e-16 *
                            simulation.bodies()[0].centre.norm() * momentum.norm();
    EXPECT_LT((simulation.angularMomentum() - angular_momentum).norm(), rounding);
    EXPECT_LT(simulation.counters().largest_quaternion_drift, 1e-15);
    if (last > 0.0) {
      EXPECT_NEAR(std::log2(last / error), 2.0, 0.1) << step;
    }
    last = error;
  }
}

// A mass on a spring: x = x0 cos(w t); the drive turns too: the same about an axis.
TEST(Simulation, ADriveSwingsWithItsFrequencyToTheSecondOrder) {
  const double omega = 10.0;
  double last_error = 0.0;
  double last_turn_error = 0.0;
  for (const double step : {4e-3, 2e-3, 1e-3}) {
    SceneBuilder builder = oneBody(2.0);
    builder.settings.gravity.setZero();
    builder.settings.largest_step = step;
    builder.settings.step_fraction = 1.0;
    SimulatedBodySettings& body = builder.settings.bodies[0];
    body.pose = at(0.1, 0.0, 0.0) * Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ());
    CompliantDrive drive;
    drive.stiffness.setConstant(2.0 * omega * omega);
    const double moment = 2.0 / 12.0 * (0.3 * 0.3 + 0.2 * 0.2);
    drive.rotational_stiffness.setConstant(moment * omega * omega);
    drive.target = {{0.0, Eigen::Isometry3d::Identity()}};
    body.drive = drive;
    Simulation simulation = builder.simulation();
    simulation.advanceTo(1.0);
    const double error = std::abs(simulation.bodies()[0].centre.x() - 0.1 * std::cos(omega));
    const Eigen::Matrix3d rotation = simulation.bodies()[0].world_from_body.linear();
    const double turn_error = std::abs(std::atan2(rotation(1, 0), rotation(0, 0)) - 0.5 * std::cos(omega));
    if (last_error > 0.0) {
      EXPECT_NEAR(std::log2(last_error / error), 2.0, 0.1) << step;
      EXPECT_NEAR(std::log2(last_turn_error / turn_error), 2.0, 0.1) << step;
    }
    last_error = error;
    last_turn_error = turn_error;
  }
  EXPECT_LT(last_error, 1e-5);
}

// Over a thousand periods the swing neither grows nor dies: a linear spring keeps its energy to rounding.
TEST(Simulation, ADriveWithoutDampingKeepsItsEnergy) {
  SceneBuilder builder = oneBody(1.0);
  builder.settings.gravity.setZero();
  builder.settings.largest_step = 1.0;
  CompliantDrive drive;
  drive.stiffness.setConstant(4.0 * M_PI * M_PI);
  drive.target = {{0.0, Eigen::Isometry3d::Identity()}};
  builder.settings.bodies[0].drive = drive;
  builder.settings.bodies[0].velocity = {1.0, 0.0, 0.0};
  Simulation simulation = builder.simulation();
  const double energy = simulation.energy().mechanical();
  double largest = 0.0;
  while (simulation.time() < 1000.0) {
    simulation.step();
    largest = std::max(largest, std::abs(simulation.energy().mechanical() / energy - 1.0));
  }
  EXPECT_LT(largest, static_cast<double>(simulation.counters().steps) * 2.3e-16);
  EXPECT_EQ(simulation.counters().limited_by[static_cast<std::size_t>(StepLimit::Accuracy)],
            simulation.counters().steps);
}

TEST(Simulation, ADampedDriveFollowsItsMovingTargetAndTheEnergiesAddUp) {
  SceneBuilder builder = oneBody(1.0);
  CompliantDrive drive;
  drive.body_from_drive = at(0.05, 0.0, 0.0);
  drive.stiffness.setConstant(1000.0);
  drive.damping.setConstant(60.0);
  drive.rotational_stiffness.setConstant(10.0);
  drive.rotational_damping.setConstant(0.3);
  TimedPose end;
  end.time = 1.0;
  end.pose = at(0.3, -0.2, 0.5) * Eigen::AngleAxisd(0.8, Eigen::Vector3d(1.0, 1.0, 0.0).normalized());
  drive.target = {{0.0, drive.body_from_drive}, end};
  builder.settings.bodies[0].drive = drive;
  builder.settings.step_fraction = 1.0;  // so that the step is constant
  builder.settings.largest_step = 5e-4;
  Simulation finer = builder.simulation();
  finer.advanceTo(3.0);
  builder.settings.largest_step = 1e-3;
  Simulation simulation = builder.simulation();
  simulation.advanceTo(3.0);
  const Eigen::Isometry3d reached = simulation.bodies()[0].world_from_body * drive.body_from_drive;
  // At rest under its weight it hangs by m g / k, and the weight's moment turns it by m g r / k_r at most.
  EXPECT_NEAR((reached.translation() - end.pose.translation()).norm(), 9.81 / 1000.0, 1e-6);
  EXPECT_LT(Eigen::AngleAxisd(Eigen::Matrix3d(reached.linear().transpose() * end.pose.linear())).angle(),
            9.81 * 0.05 / 10.0 * 1.01);
  EXPECT_LT(simulation.energy().kinetic, 1e-9);
  EXPECT_GT(simulation.energy().drive_loss, 0.0);
  EXPECT_LT(std::abs(simulation.energy().balanceError()), 1e-3 * simulation.energy().drive_loss);
  EXPECT_NEAR(simulation.energy().balanceError() / finer.energy().balanceError(), 4.0, 0.4);
}

TEST(Simulation, ALoadOverATimeSpanIsItsImpulse) {
  SceneBuilder builder = oneBody(2.0);
  builder.settings.gravity.setZero();
  builder.settings.largest_step = 0.07;  // divides neither the beginning nor the end of the load
  AppliedLoad load;
  load.force = {0.0, 3.0, 0.0};
  load.from = 0.1;
  load.until = 0.35;
  builder.settings.bodies[0].loads = {load};
  Simulation simulation = builder.simulation();
  simulation.advanceTo(1.0);
  EXPECT_NEAR(simulation.momentum().y(), 3.0 * 0.25, 1e-15);
  EXPECT_NEAR(simulation.energy().load_work, simulation.energy().kinetic, 1e-14);
}

TEST(Simulation, AForceOffTheCentreTurnsAndALoadInTheBodysFrameTurnsWithIt) {
  SceneBuilder builder = oneBody(1.0);
  builder.settings.gravity.setZero();
  AppliedLoad load;
  load.force = {0.0, 1.0, 0.0};
  load.point_in_body = {0.1, 0.0, 0.0};
  load.in_body_frame = true;
  builder.settings.bodies[0].loads = {load};
  builder.settings.largest_step = 1e-3;
  Simulation simulation = builder.simulation();
  const double time = 0.4;
  simulation.advanceTo(time);
  // About z: I w' = r F, w = a t; the force turns with the angle a t^2 / 2.
  const double moment = 1.0 / 12.0 * (0.3 * 0.3 + 0.2 * 0.2);
  const double acceleration = 0.1 / moment;
  EXPECT_NEAR(simulation.bodies()[0].angular_velocity.z(), acceleration * time, 1e-12);
  double along = 0.0;  // x of the velocity: -integral of sin
  const int parts = 10000;
  for (int i = 0; i < parts; ++i) {
    const double t = (i + 0.5) * time / parts;
    along -= std::sin(0.5 * acceleration * t * t) * time / parts;
  }
  EXPECT_NEAR(simulation.bodies()[0].velocity.x(), along, 1e-6);
}

TEST(Simulation, AnExternalWrenchAndAnotherTargetActFromNowOn) {
  SceneBuilder builder = oneBody(2.0);
  builder.settings.gravity.setZero();
  CompliantDrive drive;
  drive.stiffness.setConstant(100.0);
  drive.target = {{0.0, Eigen::Isometry3d::Identity()}};
  builder.settings.bodies[0].drive = drive;
  Simulation simulation = builder.simulation();
  simulation.advanceTo(0.5);
  EXPECT_EQ(simulation.momentum().norm(), 0.0);
  simulation.setDriveTarget(0, at(0.0, 0.0, 0.1));
  EXPECT_NEAR(simulation.energy().drive_potential, 0.5, 1e-15);
  EXPECT_NEAR(simulation.energy().balanceError(), 0.0, 1e-15);
  simulation.setDriveTarget(0, Eigen::Isometry3d::Identity());
  simulation.setExternalWrench(0, {{2.0, 0.0, 0.0}, {0.0, 0.0, 0.0}});
  simulation.advanceTo(0.501);
  EXPECT_NEAR(simulation.momentum().x(), 2e-3, 1e-6);
}

TEST(Simulation, ADrivenBodyGoesAlongItsPath) {
  SceneBuilder builder;
  builder.addBody("brick", makeBox({0.3, 0.2, 0.1}));
  SimulatedBodySettings driven;
  driven.body = "brick";
  driven.motion = BodyMotion::Driven;
  driven.path = {{0.0, at(0, 0, 0)}, {1.0, at(1, 0, 0)}};
  builder.settings.bodies = {driven};
  Simulation simulation = builder.simulation();
  simulation.advanceTo(0.25);
  EXPECT_NEAR(simulation.bodies()[0].world_from_body.translation().x(), 0.25, 1e-15);
  EXPECT_NEAR(simulation.bodies()[0].velocity.x(), 1.0, 1e-15);
}

TEST(Simulation, WhatCannotBeSimulatedIsRefusedWithItsRemedy) {
  SceneBuilder builder = oneBody();
  EXPECT_THROW(Simulation{builder.scene}, Error);  // no section
  builder.settings.bodies[0].mass.reset();
  EXPECT_THROW(builder.simulation(), Error);
  builder.settings.bodies[0].mass = 1.0;
  builder.settings.bodies[0].body = "brik";
  EXPECT_THROW(builder.simulation(), Error);
  builder.settings.bodies[0].body = "brick";
  builder.settings.largest_step = 0.0;
  EXPECT_THROW(builder.simulation(), Error);
  builder.settings.largest_step = 0.001;
  EXPECT_NO_THROW(builder.simulation());
  builder.addBody("other", makeBox({1.0, 1.0, 1.0}));
  PairSettings& pair = builder.addPair();
  pair.effects.normal_force.emplace();
  pair.tracker.accuracy = AccuracyLevel::Refined;
  EXPECT_THROW(builder.simulation(), Error);
}

// Nothing is proven, no step is shorter and nothing is written for a pair that asks for no effects.
TEST(Simulation, APairWithoutEffectsIsNotThere) {
  SceneBuilder builder = oneBody();
  builder.addBody("floor", makeBox({1.0, 1.0, 0.1}));
  builder.addPair().tracker.accuracy = AccuracyLevel::Refined;
  builder.settings.bodies[0].pose = at(0.0, 0.0, 0.2);
  Simulation simulation = builder.simulation();
  simulation.advanceTo(1.0);
  EXPECT_TRUE(simulation.pairs().empty());
  EXPECT_EQ(simulation.counters().solves, 0U);
  EXPECT_EQ(simulation.counters().limited_by[static_cast<std::size_t>(StepLimit::Distance)], 0U);
  EXPECT_NEAR(simulation.bodies()[0].centre.z(), 0.2 - 0.5 * 9.81, 1e-12);
}

TEST(Simulation, AFreeLinkTakesTheInertiaOfItsUrdf) {
  SceneBuilder builder = oneBody();
  builder.settings.bodies[0].mass.reset();
  MassProperties properties;
  properties.mass = 3.0;
  builder.scene.bodies.edit(0).inertia = properties;
  builder.settings.bodies[0].velocity = {1.0, 0.0, 0.0};
  EXPECT_EQ(builder.simulation().momentum().x(), 3.0);
}

}  // namespace
}  // namespace concave_distance::free_motion_test
