#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "concave_distance/mesh/surface/primitives.h"
#include "simulation/scene_builder.h"
#include "support/plain_shapes.h"

namespace concave_distance::contact_accuracy_test {
namespace {

using test::at;
using test::SceneBuilder;

constexpr double kRadius = 0.1;
constexpr double kGravity = 9.81;

/// An elastic ball whose lowest point is a corner of its mesh, `height` over a floor at z = 0. Every setting
/// of the simulation is the default.
SceneBuilder elasticBall(double youngs_modulus, double mass, double height) {
  SceneBuilder builder;
  Material material;
  material.youngs_modulus = youngs_modulus;
  builder.addBody("floor", makeBox({1.0, 1.0, 0.2})).material = material;
  builder.addBody("ball", makeSphere(kRadius, 0.002)).material = material;
  builder.addLumpedPair(NormalForceModel::Hertz).radius = kRadius;
  builder.setFixed("floor", at(0.0, 0.0, -0.1));
  const double lowest = builder.scene.bodies[1].mesh->surface().boundingBox().min().z();
  builder.setFree("ball", mass).pose = at(0.0, 0.0, height - lowest);
  return builder;
}

/// The height over the first one, m g h of all energy, after that many bounces.
double heightAfter(Simulation& simulation, int bounces) {
  bool touched = false;
  int count = 0;
  while (count < bounces && simulation.time() < 60.0) {
    simulation.step();
    const bool touches = !simulation.pairs()[0].contacts.regions.empty();
    if (touched && !touches) ++count;
    touched = touches;
  }
  EXPECT_EQ(count, bounces);
  return simulation.energy().mechanical() - simulation.energy().initial;
}

TEST(ContactAccuracy, TenBouncesOfAnElasticBallKeepItsHeightWithDefaultSettings) {
  const double height = 0.3;
  for (const double youngs_modulus : {1e7, 1e9, 2.1e11}) {
    const double mass = 4.0;
    SceneBuilder builder = elasticBall(youngs_modulus, mass, height);
    Simulation simulation = builder.simulation();
    const double gained = heightAfter(simulation, 10) / (mass * kGravity);
    EXPECT_LT(std::abs(gained), 0.01 * height) << youngs_modulus;
    EXPECT_TRUE(simulation.energyIsBalanced());
  }
}

TEST(ContactAccuracy, ALargeAllowedPenetrationGainsNoEnergy) {
  const double height = 0.3;
  for (const double allowed : {2e-4, 0.05, 10.0}) {
    SceneBuilder builder = elasticBall(1e7, 4.0, height);
    builder.settings.allowed_penetration = allowed;
    Simulation simulation = builder.simulation();
    EXPECT_LT(std::abs(heightAfter(simulation, 5)) / (4.0 * kGravity), 0.005 * height) << allowed;
  }
}

// Swinging about the depth that its weight presses it to, a ball never leaves the floor: the force is smooth.
TEST(ContactAccuracy, ASmoothContactIsOfSecondOrder) {
  const double mass = 4.0;
  const double modulus = [] {
    Material material;
    material.youngs_modulus = 1e7;
    return inContact(material, material).contact_modulus;
  }();
  const double depth = std::pow(0.75 * mass * kGravity / (modulus * std::sqrt(kRadius)), 2.0 / 3.0);
  const auto place = [&](double step) {
    SceneBuilder builder = elasticBall(1e7, mass, -0.6 * depth);
    builder.settings.step_fraction = 1.0;  // so that the step is constant
    builder.settings.largest_step = step;
    Simulation simulation = builder.simulation();
    simulation.advanceTo(0.1);
    EXPECT_EQ(simulation.counters().limited_by[static_cast<std::size_t>(StepLimit::Accuracy)], 0U);
    return simulation.bodies()[1].centre.z();
  };
  const double reference = place(0.1 / 8192);
  double last = 0.0;
  for (const int steps : {64, 128, 256}) {
    const double error = std::abs(place(0.1 / steps) - reference);
    if (last > 0.0) {
      EXPECT_NEAR(std::log2(last / error), 2.0, 0.1) << steps;
    }
    last = error;
  }
}

/// A box with a box-shaped hole inside.
SurfaceMesh makeHollowBox(double size, double hole) {
  return test::makeJoined(makeBox({size, size, size}), test::makeTurned(makeBox({hole, hole, hole})));
}

TEST(ContactAccuracy, CollisionsKeepMomentumAndAngularMomentumOverManySteps) {
  SceneBuilder builder;
  Material material;
  material.youngs_modulus = 1e8;
  builder.addBody("box", makeHollowBox(1.0, 0.8)).material = material;
  builder.addBody("ball", makeSphere(kRadius, 0.01)).material = material;
  EffectSettings& effects = builder.addPair().effects;
  effects.normal_force.emplace();
  effects.normal_force->radius = kRadius;
  effects.friction.model = FrictionModel::Bristle;
  builder.setFree("box", 3.0).velocity = {0.1, -0.05, 0.02};
  SimulatedBodySettings& ball = builder.setFree("ball", 1.0);
  ball.velocity = {1.3, 0.9, 0.7};
  ball.angular_velocity = {0.5, 0.2, -0.3};
  builder.settings.gravity.setZero();
  builder.settings.largest_step = 1e-3;
  builder.settings.tracking = SimulationTracking::SingleMinimum;
  Simulation simulation = builder.simulation();
  const Eigen::Vector3d momentum = simulation.momentum();
  const Eigen::Vector3d angular_momentum = simulation.angularMomentum();
  double farthest = 0.0;
  double largest_impulse = momentum.norm();
  for (int i = 0; i < 40000; ++i) {
    simulation.step();
    farthest = std::max(farthest, simulation.bodies()[0].centre.norm());
    largest_impulse = std::max(largest_impulse, 3.0 * simulation.bodies()[0].velocity.norm());
  }
  EXPECT_GT(simulation.counters().contact_steps, 100U);
  EXPECT_EQ(simulation.status(), SimulationStatus::Ok);
  // Each addition is rounded: steps times epsilon times the largest number added.
  const double rounding = 4e4 * 2.3e-16 * largest_impulse;
  EXPECT_LT((simulation.momentum() - momentum).norm(), rounding);
  EXPECT_LT((simulation.angularMomentum() - angular_momentum).norm(), rounding * (1.0 + farthest));
}

TEST(ContactAccuracy, TheEnergyBalanceIsHeldToItsTolerance) {
  SceneBuilder builder = elasticBall(1e7, 4.0, 0.1);
  Simulation simulation = builder.simulation();
  simulation.advanceTo(0.5);
  EXPECT_TRUE(simulation.energyIsBalanced());
  EXPECT_GT(simulation.energy().balanceShare(), 0.0);
  builder.settings.energy_tolerance = 0.5 * simulation.energy().balanceShare();
  Simulation strict = builder.simulation();
  strict.advanceTo(0.5);
  EXPECT_FALSE(strict.energyIsBalanced());
}

}  // namespace
}  // namespace concave_distance::contact_accuracy_test
