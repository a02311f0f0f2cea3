// Balls that are held back by rolling and spinning friction, against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "base/constants.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "simulation/scene_builder.h"

namespace concave_distance::rolling_friction_test {
namespace {

using test::at;
using test::SceneBuilder;

constexpr double kRadius = 0.1;
constexpr double kMass = 1.0;
constexpr double kGravity = 9.81;
constexpr double kFoundation = 1e8;  // Pa/m
constexpr double kArm = 0.01;        // of rolling and spinning friction, metres
constexpr double kShare = kArm / kRadius;
constexpr ForceDistribution kDistributions[] = {ForceDistribution::Pressure, ForceDistribution::Lumped};
constexpr FrictionModel kModels[] = {FrictionModel::RegularisedCoulomb, FrictionModel::Bristle};

struct Ball {
  FrictionModel friction = FrictionModel::Bristle;
  ForceDistribution distribution = ForceDistribution::Lumped;
  double rolling_friction = 0.0;
  double spinning_friction = 0.0;
  double slope = 0.0;  // radians
};

/// How deep the ball's weight presses it in: of the cap's volume pi R d^2.
double depthAtRest() {
  return std::sqrt(kMass * kGravity / (kPi * kRadius * kFoundation));
}

/// A ball of 1 kg on the plane z = 0, as deep in it as it is at rest; gravity is inclined by the slope.
SceneBuilder ballOnPlane(const Ball& ball) {
  SceneBuilder builder;
  Material material;
  material.rolling_friction = ball.rolling_friction;
  material.spinning_friction = ball.spinning_friction;
  builder.addBody("plane", makeBox({6.0, 1.0, 0.2})).material = material;
  builder.addBody("ball", makeSphere(kRadius, 5e-5)).material = material;
  EffectSettings& effects = builder.addPair().effects;
  effects.normal_force.emplace();
  effects.normal_force->model = NormalForceModel::ElasticFoundation;
  effects.normal_force->distribution = ball.distribution;
  effects.normal_force->foundation_stiffness = kFoundation;
  effects.friction.model = ball.friction;
  builder.setFixed("plane", at(0.0, 0.0, -0.1));
  SimulatedBodySettings& settings = builder.setFree("ball", kMass);
  settings.pose = at(0.0, 0.0, kRadius - depthAtRest());
  settings.mass.reset();
  settings.inertia.emplace();
  settings.inertia->mass = kMass;
  settings.inertia->inertia = 0.4 * kMass * kRadius * kRadius * Eigen::Matrix3d::Identity();
  builder.settings.gravity = kGravity * Eigen::Vector3d(std::sin(ball.slope), 0.0, -std::cos(ball.slope));
  builder.settings.tracking = SimulationTracking::SingleMinimum;
  return builder;
}

/// A ball that rolls with this speed.
SceneBuilder rollingBall(FrictionModel model, ForceDistribution distribution, double speed) {
  SceneBuilder builder = ballOnPlane({model, distribution, kArm});
  builder.settings.bodies.back().velocity = {speed, 0.0, 0.0};
  builder.settings.bodies.back().angular_velocity = {0.0, speed / kRadius, 0.0};
  return builder;
}

TEST(RollingFriction, ABallRollsAsFarAsItsEnergyTakesIt) {
  const double speed = 0.25;
  const double deceleration = 5.0 / 7.0 * kGravity * kShare;
  const double distance = 0.5 * speed * speed / deceleration;
  const double energy_at_begin = 0.7 * kMass * speed * speed;
  for (const FrictionModel model : kModels) {
    for (const ForceDistribution distribution : kDistributions) {
      Simulation simulation = rollingBall(model, distribution, speed).simulation();
      simulation.advanceTo(1.2 * speed / deceleration);
      EXPECT_NEAR(simulation.bodies()[1].centre.x(), distance, 0.02 * distance)
          << toString(model) << ", " << toString(distribution);
      // All that it had went into friction.
      const EnergyAccount& energy = simulation.energy();
      EXPECT_NEAR(energy.friction_work, -energy_at_begin, 0.02 * energy_at_begin);
      EXPECT_LT(std::abs(energy.balanceError()), 0.01 * energy_at_begin);
    }
  }
}

TEST(RollingFriction, InShortStepsTheEnergyAccountCloses) {
  const double speed = 0.5;
  for (const ForceDistribution distribution : kDistributions) {
    SceneBuilder builder = rollingBall(FrictionModel::Bristle, distribution, speed);
    builder.settings.largest_step = 2e-4;
    Simulation simulation = builder.simulation();
    simulation.advanceTo(0.1);
    EXPECT_LT(std::abs(simulation.energy().balanceError()), 1e-4 * 0.7 * kMass * speed * speed)
        << toString(distribution);
  }
}

TEST(RollingFriction, ABallThatSpinsOnTheSpotStops) {
  const double rate = 10.0;
  for (const FrictionModel model : kModels) {
    for (const ForceDistribution distribution : kDistributions) {
      SceneBuilder builder = ballOnPlane({model, distribution, 0.0, kArm});
      builder.settings.bodies.back().angular_velocity = {0.0, 0.0, rate};
      Simulation simulation = builder.simulation();
      // Over the patch of radius a = sqrt(2 R d), pressed in proportion to 1 - (r/a)^2, 8/15 mu a comes on
      // top.
      double arm = kArm;
      if (distribution == ForceDistribution::Pressure)
        arm += 8.0 / 15.0 * Material().dynamic_friction * std::sqrt(2.0 * kRadius * depthAtRest());
      const double stop = rate * 0.4 * kRadius * kRadius / (arm * kGravity);
      simulation.advanceTo(0.7 * stop);
      EXPECT_NEAR(simulation.bodies()[1].angular_velocity.z(), 0.3 * rate, 0.01 * rate)
          << toString(model) << ", " << toString(distribution);
      simulation.advanceTo(1.2 * stop);
      EXPECT_NEAR(simulation.bodies()[1].angular_velocity.z(), 0.0, 1e-3 * rate)
          << toString(model) << ", " << toString(distribution);
      const double energy = 0.2 * kMass * kRadius * kRadius * rate * rate;
      EXPECT_LT(std::abs(simulation.energy().balanceError()), 0.01 * energy);
    }
  }
}

// Sampled pressures of a meshed ball are never quite even: it trembles by some 1e-9 m.
TEST(RollingFriction, BelowItsAngleABallStandsStill) {
  for (const ForceDistribution distribution : kDistributions) {
    Simulation simulation =
        ballOnPlane({FrictionModel::Bristle, distribution, kArm, 0.0, 0.9 * std::atan(kShare)}).simulation();
    simulation.advanceTo(3.0);
    const Eigen::Vector3d place = simulation.bodies()[1].centre;
    EXPECT_LT(std::abs(place.x()), 1e-3) << toString(distribution);
    simulation.advanceTo(8.0);
    const double still = distribution == ForceDistribution::Lumped ? 1e-12 : 1e-7;
    EXPECT_LT((simulation.bodies()[1].centre - place).norm(), still) << toString(distribution);
  }
}

TEST(RollingFriction, AboveItsAngleItRollsAsTheClosedFormSays) {
  const double slope = 2.0 * std::atan(kShare);
  const double expected = 5.0 / 7.0 * kGravity * (std::sin(slope) - kShare * std::cos(slope));
  for (const FrictionModel model : kModels) {
    for (const ForceDistribution distribution : kDistributions) {
      Simulation simulation = ballOnPlane({model, distribution, kArm, 0.0, slope}).simulation();
      simulation.advanceTo(0.1);
      const double before = simulation.bodies()[1].velocity.x();
      simulation.advanceTo(0.3);
      EXPECT_NEAR((simulation.bodies()[1].velocity.x() - before) / 0.2, expected, 0.02 * expected)
          << toString(model) << ", " << toString(distribution);
    }
  }
}

// Where bristles stick the regularised model turns at the rate at which its torque holds the ball.
TEST(RollingFriction, TheRegularisedModelCreeps) {
  const double slope = 0.8 * std::atan(kShare);
  Simulation simulation =
      ballOnPlane({FrictionModel::RegularisedCoulomb, ForceDistribution::Lumped, kArm, 0.0, slope})
          .simulation();
  simulation.advanceTo(1.0);
  const double turn = simulation.bodies()[1].world_from_body.linear()(0, 2);
  simulation.advanceTo(3.0);
  const double rate = (simulation.bodies()[1].world_from_body.linear()(0, 2) - turn) / 2.0;
  const double needed = std::tan(slope);
  const double creep =
      FrictionSettings().regularisation_speed * needed / std::sqrt(kShare * kShare - needed * needed);
  EXPECT_NEAR(rate, creep / kRadius, 0.02 * creep / kRadius);
}

}  // namespace
}  // namespace concave_distance::rolling_friction_test
