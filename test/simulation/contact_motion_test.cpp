#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "concave_distance/mesh/surface/primitives.h"
#include "distance/kernels/pair_motion.h"
#include "simulation/scene_builder.h"
#include "support/hunt_crossley_rebound.h"

namespace concave_distance::contact_motion_test {
namespace {

using test::at;
using test::SceneBuilder;

constexpr double kRadius = 0.1;
constexpr double kMass = 1.0;
constexpr double kDissipation = 0.3;

/// A ball over a block whose upper face is z = 0; the ball's lowest point is a corner of its mesh, at
/// `height`. The radius that the force counts with is the true one.
SceneBuilder ballOnBlock(NormalForceModel model, double height, double speed) {
  SceneBuilder builder;
  Material material;
  material.youngs_modulus = 1e7;
  material.dissipation = kDissipation;
  builder.addBody("block", makeBox({1.0, 1.0, 0.2})).material = material;
  builder.addBody("ball", makeSphere(kRadius, 0.002)).material = material;
  builder.addLumpedPair(model).radius = kRadius;
  builder.setFixed("block", at(0.0, 0.0, -0.1));
  SimulatedBodySettings& ball = builder.setFree("ball", kMass);
  const double lowest = builder.scene.bodies[1].mesh->surface().boundingBox().min().z();
  ball.pose = at(0.0, 0.0, height - lowest);
  ball.velocity = {0.0, 0.0, -speed};
  builder.settings.gravity.setZero();
  builder.settings.tracking = SimulationTracking::SingleMinimum;
  return builder;
}

double modulus(const SceneBuilder& builder) {
  return inContact(builder.scene.bodies[0].material, builder.scene.bodies[1].material).contact_modulus;
}

/// Runs until the ball is clear again. @return its speed upwards
double rebound(Simulation& simulation) {
  bool touched = false;
  for (int step = 0; step < 200000; ++step) {
    simulation.step();
    const SimulatedPair& pair = simulation.pairs()[0];
    touched = touched || !pair.contacts.regions.empty();
    if (touched && pair.contacts.regions.empty() && simulation.bodies()[1].velocity.z() > 0.0) break;
  }
  return simulation.bodies()[1].velocity.z();
}

TEST(ContactMotion, RestitutionFollowsHuntAndCrossleyOverTheSpeeds) {
  for (const double speed : {0.05, 0.2, 1.0, 3.0}) {
    SceneBuilder builder = ballOnBlock(NormalForceModel::HuntCrossley, 1e-3, speed);
    builder.settings.allowed_penetration = 1e-4 * std::pow(speed, 0.8);  // a share of the depth reached
    builder.settings.step_fraction = 0.05;
    Simulation simulation = builder.simulation();
    const double expected = test::huntCrossleyRebound(speed, kDissipation);
    EXPECT_NEAR(rebound(simulation), expected, 2e-3 * speed) << speed;
    // What is lost is the contact's work, and no more than the integration's error is made of nothing.
    const EnergyAccount& energy = simulation.energy();
    EXPECT_LT(energy.normal_work, 0.0);
    EXPECT_LT(std::abs(energy.balanceError()), 5e-3 * energy.initial) << speed;
  }
}

// Where begin and end of the contact are resolved as well: finer steps, less error.
TEST(ContactMotion, AHertzBounceGivesBackItsSpeed) {
  const double speed = 1.0;
  for (const double fraction : {0.2, 0.1, 0.02}) {
    SceneBuilder builder = ballOnBlock(NormalForceModel::Hertz, 1e-3, speed);
    builder.settings.step_fraction = fraction;
    Simulation simulation = builder.simulation();
    EXPECT_NEAR(rebound(simulation), speed, 0.1 * fraction * fraction * speed) << fraction;
  }
}

TEST(ContactMotion, UnderItsWeightABallDipsInAsHertzSays) {
  SceneBuilder builder = ballOnBlock(NormalForceModel::HuntCrossley, 0.0, 0.0);
  builder.settings.gravity = {0.0, 0.0, -9.81};
  CompliantDrive brake;  // brings it to rest in time
  brake.damping.setConstant(150.0);
  brake.target = {{0.0, Eigen::Isometry3d::Identity()}};
  builder.settings.bodies[1].drive = brake;
  Simulation simulation = builder.simulation();
  simulation.advanceTo(0.5);
  const double expected =
      std::pow(kMass * 9.81 * 3.0 / (4.0 * modulus(builder) * std::sqrt(kRadius)), 2.0 / 3.0);
  ASSERT_EQ(simulation.pairs()[0].contacts.regions.size(), 1U);
  EXPECT_NEAR(simulation.pairs()[0].contacts.regions[0].overlap.depth, expected, 1e-6 * expected);
  EXPECT_NEAR(simulation.bodies()[1].contact_wrench.force.z(), kMass * 9.81, 1e-5 * kMass * 9.81);
}

// A plate of 1 mm and steps of 10 ms: at 300 m/s the ball would be 3 m on.
TEST(ContactMotion, AFastBallDoesNotPassThroughAThinPlate) {
  SceneBuilder builder;
  Material material;
  material.youngs_modulus = 2e13;  // so hard that the dip stays below the plate's thickness
  builder.addBody("plate", makeBox({1.0, 1.0, 0.001})).material = material;
  builder.addBody("ball", makeSphere(0.02, 0.002)).material = material;
  builder.addLumpedPair(NormalForceModel::Hertz).radius = 0.02;
  SimulatedBodySettings& ball = builder.setFree("ball", 0.03);
  ball.pose = at(0.1, 0.05, 5.0);
  ball.velocity = {3.0, 0.0, -300.0};
  ball.angular_velocity = {0.0, 50.0, 0.0};
  builder.settings.largest_step = 0.01;
  builder.settings.allowed_penetration = 5e-5;
  builder.settings.tracking = SimulationTracking::SingleMinimum;
  Simulation simulation = builder.simulation();
  double lowest = 5.0;
  for (int i = 0; i < 20000 && simulation.time() < 0.03; ++i) {
    simulation.step(0.03);
    lowest = std::min(lowest, simulation.bodies()[1].centre.z());
  }
  EXPECT_GT(lowest, 0.018);
  EXPECT_GT(simulation.bodies()[1].velocity.z(), 200.0);  // a corner of the ball hits: a part goes into spin
}

TEST(ContactMotion, ABulletFastPegDoesNotEitherHoweverItTumbles) {
  SceneBuilder builder;
  Material material;
  material.youngs_modulus = 2e12;
  builder.addBody("plate", makeBox({1.0, 1.0, 0.002})).material = material;
  builder.addBody("peg", makeCylinder(0.004, 0.06, 0.001)).material = material;
  builder.addLumpedPair(NormalForceModel::SpringDashpot).stiffness = 5e9;
  SimulatedBodySettings& peg = builder.setFree("peg", 0.02);
  peg.pose = at(0.0, 0.0, 1.0) * Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX());
  peg.velocity = {0.0, 0.0, -800.0};
  peg.angular_velocity = {200.0, 30.0, 1000.0};
  builder.settings.largest_step = 0.01;
  builder.settings.allowed_penetration = 1e-4;
  builder.settings.tracking = SimulationTracking::SingleMinimum;
  Simulation simulation = builder.simulation();
  for (int i = 0; i < 20000 && simulation.time() < 0.004; ++i) {
    simulation.step(0.004);
    ASSERT_GT(simulation.bodies()[1].centre.z(), 0.0) << simulation.time();
  }
  EXPECT_GT(simulation.counters().contact_steps, 0U);
}

// The promise of the step rule, seen from the fixed body's frame.
TEST(ContactMotion, NoPointMovesFartherInAStepThanTheProvenDistanceAndTheAllowance) {
  SceneBuilder builder;
  builder.addBody("block", makeBox({1.0, 1.0, 0.2}));
  builder.addBody("stick", makeBox({0.5, 0.05, 0.03}));
  builder.addLumpedPair(NormalForceModel::SpringDashpot).stiffness = 2e5;
  SimulatedBodySettings& stick = builder.setFree("stick", 0.5);
  stick.pose = at(0.0, 0.0, 0.5);
  stick.velocity = {0.0, 0.5, -3.0};
  stick.angular_velocity = {5.0, 20.0, 3.0};
  builder.settings.largest_step = 1.0;
  builder.settings.step_fraction = 1.0;
  builder.settings.allowed_penetration = 2e-4;
  builder.settings.tracking = SimulationTracking::SingleMinimum;
  Simulation simulation = builder.simulation();
  const Eigen::AlignedBox3d box = builder.scene.bodies[1].mesh->surface().boundingBox();
  for (int i = 0; i < 3000; ++i) {
    const SimulatedPair before = simulation.pairs()[0];
    simulation.step();
    const double displacement =
        detail::PairMotion(before.a_from_b, simulation.pairs()[0].a_from_b).largestIn(box);
    ASSERT_LE(displacement, before.lower_bound + 2e-4 + 1e-12) << i;
  }
  EXPECT_GT(simulation.counters().contact_steps, 0U);
  EXPECT_GT(simulation.counters().limited_by[static_cast<std::size_t>(StepLimit::Distance)], 0U);
}

// Seen from the plate the ball comes with 1 m/s and leaves with 1 m/s.
TEST(ContactMotion, ADrivenPlateThrowsABallAtTwiceItsSpeed) {
  SceneBuilder builder = ballOnBlock(NormalForceModel::Hertz, 0.02, 0.0);
  SimulatedBodySettings& block = builder.settings.bodies[0];
  block.motion = BodyMotion::Driven;
  block.path = {{0.0, at(0.0, 0.0, -0.1)}, {1.0, at(0.0, 0.0, 0.9)}};
  builder.settings.step_fraction = 0.03;
  builder.settings.allowed_penetration = 1e-4;
  Simulation simulation = builder.simulation();
  simulation.advanceTo(0.2);
  EXPECT_NEAR(simulation.bodies()[1].velocity.z(), 2.0, 0.01);
  EXPECT_NEAR(simulation.energy().normal_work, simulation.energy().kinetic,
              0.01 * simulation.energy().kinetic);
}

TEST(ContactMotion, TwoEqualBallsChangeTheirVelocitiesAndKeepTheirMomentum) {
  SceneBuilder builder;
  Material material;
  material.youngs_modulus = 1e7;
  builder.addBody("one", makeSphere(kRadius, 0.002)).material = material;
  builder.addBody("other", makeSphere(kRadius, 0.002)).material = material;
  builder.addLumpedPair(NormalForceModel::Hertz).radius = 0.5 * kRadius;
  builder.setFree("one", kMass).velocity = {0.1, 0.0, 0.7};
  SimulatedBodySettings& other = builder.setFree("other", kMass);
  other.pose = at(0.0, 0.0, 2.0 * kRadius + 0.01);
  other.velocity = {0.1, 0.0, -0.3};
  builder.settings.gravity.setZero();
  builder.settings.step_fraction = 0.03;
  builder.settings.allowed_penetration = 1e-4;
  builder.settings.tracking = SimulationTracking::SingleMinimum;
  Simulation simulation = builder.simulation();
  const Eigen::Vector3d momentum = simulation.momentum();
  const Eigen::Vector3d angular_momentum = simulation.angularMomentum();
  simulation.advanceTo(0.1);
  EXPECT_GT(simulation.counters().contact_steps, 0U);
  EXPECT_NEAR(simulation.bodies()[0].velocity.z(), -0.3, 0.005);
  EXPECT_NEAR(simulation.bodies()[1].velocity.z(), 0.7, 0.005);
  EXPECT_LT((simulation.momentum() - momentum).norm(), 1e-12);
  EXPECT_LT((simulation.angularMomentum() - angular_momentum).norm(), 1e-12);
}

TEST(ContactMotion, OneSceneOneAnswer) {
  const auto run = [] {
    SceneBuilder builder = ballOnBlock(NormalForceModel::HuntCrossley, 1e-3, 1.0);
    builder.settings.tracking = SimulationTracking::Both;
    builder.settings.bodies[1].angular_velocity = {1.0, 2.0, 3.0};
    Simulation simulation = builder.simulation();
    simulation.advanceTo(0.02);
    return simulation.bodies()[1].centre;
  };
  EXPECT_EQ(run(), run());
}

TEST(ContactMotion, NichesAreThereAtEveryTimeThatIsAskedFor) {
  SceneBuilder builder = ballOnBlock(NormalForceModel::HuntCrossley, 0.5, 0.0);
  builder.settings.tracking = SimulationTracking::Niches;
  builder.settings.duration = 10.0;
  builder.settings.largest_step = 1e-3;  // sums of it miss the times by rounding
  Simulation simulation = builder.simulation();
  for (int line = 1; line <= 500; ++line) {
    simulation.advanceTo(line / 50.0);
    ASSERT_FALSE(simulation.pairs()[0].solution.niches.empty()) << simulation.time();
  }
}

TEST(ContactMotion, APairBeyondItsCutoffIsNotSolved) {
  SceneBuilder builder = ballOnBlock(NormalForceModel::HuntCrossley, 0.5, 1.0);
  builder.scene.pairs.edit(0).settings.tracker.cutoff = 0.1;
  Simulation simulation = builder.simulation();
  simulation.advanceTo(0.3);
  EXPECT_EQ(simulation.counters().solves, 0U);
  EXPECT_FALSE(simulation.pairs()[0].solved);
  EXPECT_GT(simulation.pairs()[0].lower_bound, 0.1);
  simulation.advanceTo(0.48);
  EXPECT_GT(simulation.counters().solves, 0U);
  simulation.advanceTo(0.6);
  EXPECT_GT(simulation.bodies()[1].velocity.z(), 0.0);
}

}  // namespace
}  // namespace concave_distance::contact_motion_test
