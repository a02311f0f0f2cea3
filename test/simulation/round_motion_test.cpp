// Exact round bodies in motion, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "concave_distance/mesh/surface/primitives.h"
#include "simulation/scene_builder.h"
#include "support/round_bodies.h"

namespace concave_distance::round_motion_test {
namespace {

using Eigen::Vector3d;
using test::at;
using test::SceneBuilder;

constexpr double kGravity = 9.80665;

SceneBuilder onGround(const RoundShape& shape, NormalForceModel model, const Material& material) {
  SceneBuilder builder;
  builder.addBody("ground", makeBox({20.0, 4.0, 2.0})).material = material;
  builder.addRoundBody("round", shape).material = material;
  NormalForceSettings force;
  force.model = model;
  force.foundation_stiffness = 1e9;
  PairSettings& pair = builder.addPair();
  pair.effects.normal_force = force;
  pair.effects.interference = true;
  builder.setFixed("ground", at(0.0, 0.0, -1.0));
  builder.settings.tracking = SimulationTracking::SingleMinimum;
  return builder;
}

Material steel() {
  Material material;
  material.youngs_modulus = 2.1e11;
  material.poissons_ratio = 0.3;
  material.dissipation = 0.0;
  return material;
}

TEST(RoundMotion, ASteelBallKeepsItsHeightOverTenBounces) {
  const double radius = 0.05;
  SceneBuilder builder = onGround(test::sphereOf(radius), NormalForceModel::Hertz, steel());
  SimulatedBodySettings& ball = builder.setFree("round", 1.0);
  ball.pose = at(0.0, 0.0, radius + 0.2);
  ball.pose.linear() = Eigen::AngleAxisd(0.7, Vector3d(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
  Simulation simulation = builder.simulation();
  std::vector<double> heights;
  double before = 0.0;
  while (heights.size() < 10 && simulation.time() < 6.0) {
    simulation.step();
    const SimulatedBody& now = simulation.bodies()[1];
    if (before > 0.0 && now.velocity.z() <= 0.0) heights.push_back(now.centre.z() - radius);
    before = now.velocity.z();
  }
  ASSERT_EQ(heights.size(), 10U);
  EXPECT_NEAR(heights.back(), 0.2, 0.002);
  EXPECT_NEAR(simulation.bodies()[1].centre.x(), 0.0, 1e-9);
  EXPECT_NEAR(simulation.bodies()[1].angular_velocity.norm(), 0.0, 1e-6);
}

TEST(RoundMotion, ABallAtRestDoesNotRollOff) {
  Material material;
  material.youngs_modulus = 1e8;
  const double radius = 0.05;
  SceneBuilder builder = onGround(test::sphereOf(radius), NormalForceModel::HuntCrossley, material);
  SimulatedBodySettings& ball = builder.setFree("round", 0.5);
  ball.pose = at(0.003, 0.002, radius);
  ball.pose.linear() = Eigen::AngleAxisd(0.7, Vector3d(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
  Simulation simulation = builder.simulation();
  simulation.advanceTo(5.0);
  const SimulatedBody& now = simulation.bodies()[1];
  EXPECT_NEAR((now.centre.head<2>() - Eigen::Vector2d(0.003, 0.002)).norm(), 0.0, 1e-9);
  EXPECT_NEAR(now.velocity.norm(), 0.0, 1e-6);
  // Hertz's depth under its weight, from the integrals over the patch alone: no radius is given.
  const double modulus = inContact(material, material).contact_modulus;
  const double depth = std::pow(0.5 * kGravity / (4.0 / 3.0 * modulus * std::sqrt(radius)), 2.0 / 3.0);
  EXPECT_NEAR(radius - now.centre.z(), depth, 2e-3 * depth);
}

/// Rolls down a slope of 0.1 for a second. @return its acceleration over g sin
double rolled(const RoundShape& shape, const Eigen::Matrix3d& turn, double mass) {
  Material material;
  material.youngs_modulus = 1e9;
  material.static_friction = material.dynamic_friction = 0.6;
  SceneBuilder builder = onGround(shape, NormalForceModel::HuntCrossley, material);
  builder.scene.pairs.edit(0).settings.effects.friction.model = FrictionModel::Bristle;
  builder.settings.gravity = kGravity * Vector3d(std::sin(0.1), 0.0, -std::cos(0.1));
  SimulatedBodySettings& round = builder.setFree("round", mass);
  round.pose = at(-3.0, 0.0, shape.radius);
  round.pose.linear() = turn;
  Simulation simulation = builder.simulation();
  simulation.advanceTo(1.0);
  const SimulatedBody& now = simulation.bodies()[1];
  return 2.0 * (now.centre.x() + 3.0) / (kGravity * std::sin(0.1));
}

TEST(RoundMotion, RollsDownASlopeWithItsMomentOfInertia) {
  const Eigen::Matrix3d any = Eigen::AngleAxisd(0.7, Vector3d(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
  const Eigen::Matrix3d lying = Eigen::AngleAxisd(0.5 * M_PI, Vector3d::UnitX()).toRotationMatrix();
  EXPECT_NEAR(rolled(test::sphereOf(0.1), any, 1.0), 5.0 / 7.0, 5e-3);
  EXPECT_NEAR(rolled(test::roundShape(RoundKind::Cylinder, 0.1, 0.1), lying, 1.0), 2.0 / 3.0, 5e-3);
  const RoundShape capsule = test::roundShape(RoundKind::Capsule, 0.1, 0.1);
  const double moment = massPropertiesOfMass(capsule, 1.0, "capsule").inertia(2, 2) / 0.01;
  EXPECT_NEAR(rolled(capsule, lying, 1.0), 1.0 / (1.0 + moment), 5e-3);
}

// Pressure and friction the same all over the face: torque 2/3 mu m g R against an inertia of m R^2 / 2.
TEST(RoundMotion, ASpinningDiscStopsAsEvenPressureSays) {
  Material material;
  material.static_friction = material.dynamic_friction = 0.4;
  material.dissipation = 20.0;
  const RoundShape disc = test::roundShape(RoundKind::Cylinder, 0.1, 0.02);
  SceneBuilder builder = onGround(disc, NormalForceModel::ElasticFoundation, material);
  builder.scene.pairs.edit(0).settings.effects.friction.model = FrictionModel::Bristle;
  builder.scene.pairs.edit(0).settings.effects.normal_force->foundation_stiffness = 2e6;
  const double depth = kGravity / (2e6 * M_PI * 0.01);
  SimulatedBodySettings& spinning = builder.setFree("round", 1.0);
  spinning.pose = at(0.01, 0.02, 0.02 - depth);
  spinning.angular_velocity = {0.0, 0.0, 10.0};
  Simulation simulation = builder.simulation();
  const double expected = 10.0 * 0.1 * 0.75 / (0.4 * kGravity);
  while (simulation.time() < 2.0 * expected && simulation.bodies()[1].angular_velocity.z() > 0.05)
    simulation.step();
  EXPECT_NEAR(simulation.time(), 0.995 * expected, 0.02 * expected);
}

TEST(RoundMotion, MassesAreThoseOfTheSolids) {
  for (const RoundKind kind : {RoundKind::Sphere, RoundKind::Capsule, RoundKind::Cylinder}) {
    RoundShape shape = test::roundShape(kind, 0.3, kind == RoundKind::Sphere ? 0.0 : 0.4, 1e-4);
    shape.body_from_shape = at(1.0, 2.0, 3.0) * Eigen::AngleAxisd(0.5, Vector3d(1, 2, 2) / 3.0);
    const MassProperties exact = massPropertiesOf(shape, 1000.0, "solid");
    const MassProperties mesh = massPropertiesOf(inscribedMesh(shape, "mesh"), 1000.0, "mesh");
    EXPECT_NEAR(mesh.mass / exact.mass, 1.0, 1e-3);
    EXPECT_LT(mesh.mass, exact.mass);
    EXPECT_NEAR((mesh.centre_in_body - exact.centre_in_body).norm(), 0.0, 1e-9);
    EXPECT_NEAR((mesh.inertia - exact.inertia).norm(), 0.0, 2e-3 * exact.inertia.norm());
  }
}

}  // namespace
}  // namespace concave_distance::round_motion_test
