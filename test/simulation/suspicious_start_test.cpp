// Probable mistakes in a scene are named before the run.
#include <gtest/gtest.h>

#include <string>

#include "simulation/box_stack.h"
#include "simulation/elastic_ball.h"
#include "simulation/suspicious_start.h"
#include "support/plain_shapes.h"

namespace concave_distance::suspicious_start_test {
namespace {

using test::ElasticBall;
using test::SceneBuilder;
using test::stackOf;

std::vector<std::string> warningsOf(const SceneBuilder& builder) {
  return builder.simulation().warnings();
}

void expectOne(const SceneBuilder& builder, const std::string& part) {
  const std::vector<std::string> warnings = warningsOf(builder);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find(part), std::string::npos) << warnings[0];
}

MassProperties massOf(double mass, double moment, const Eigen::Vector3d& centre) {
  MassProperties properties;
  properties.mass = mass;
  properties.inertia = moment * Eigen::Matrix3d::Identity();
  properties.centre_in_body = centre;
  return properties;
}

SceneBuilder boxWith(const MassProperties& properties) {
  SceneBuilder builder = stackOf({1.0});
  builder.settings.bodies[1].mass.reset();
  builder.settings.bodies[1].inertia = properties;
  return builder;
}

TEST(SuspiciousStart, ABallDeepInTheFloorIsNamedWithWhatItGains) {
  expectOne(ElasticBall{0.1}.overPlane(-0.1),
            "body 'ball' begins 0.1 m deep in 'ground', which throws it out");
}

// The estimate is what comes out of it, to the third that the power of the force leaves open.
TEST(SuspiciousStart, TheEnergyNamedIsWhatComesOut) {
  const SceneBuilder builder = ElasticBall{0.1}.overPlane(-0.02);
  Simulation simulation = builder.simulation();
  ASSERT_EQ(simulation.warnings().size(), 1U);
  const std::string& text = simulation.warnings()[0];
  const double named = std::stod(text.substr(text.find("with about ") + 11));
  simulation.advanceTo(0.2);
  EXPECT_NEAR(named / simulation.energy().largest_kinetic, 1.0, 0.3) << text;
}

TEST(SuspiciousStart, WhatRestsOrBouncesIsNot) {
  EXPECT_TRUE(warningsOf(ElasticBall{0.1}.overPlane(0.3)).empty());
  EXPECT_TRUE(warningsOf(ElasticBall{0.1}.rollingOnPlane(0.1, 1.0)).empty());
  EXPECT_TRUE(warningsOf(stackOf({1.0})).empty());
}

TEST(SuspiciousStart, AMassThatCannotLieInTheBodyIsNamed) {
  EXPECT_TRUE(warningsOf(boxWith(massOf(1.0, 5e-3, {0.02, 0.0, 0.0}))).empty());
  expectOne(boxWith(massOf(1.0, 5e-3, {0.0, 50.0, 0.0})),
            "body 'box0' has its centre of mass 49.9 m outside");
  expectOne(
      boxWith(massOf(1.0, 1000.0, Eigen::Vector3d::Zero())),
      "body 'box0' has a largest moment of inertia of 1000 kg m^2; 1 kg at its farthest point would have ");
  expectOne(boxWith(massOf(1.0, 1e-9, Eigen::Vector3d::Zero())),
            "a largest moment of inertia of 1e-09 kg m^2");
}

TEST(SuspiciousStart, FreeBodiesWithoutAPairAreNamedOnce) {
  SceneBuilder builder = stackOf({1.0, 1.0, 1.0});
  expectOne(builder,
            "free bodies without a pair pass through each other: 'box0' and 'box2'; add `- between: ");
  ScenePair meant;
  meant.name = "meant";
  meant.body_a = 3;
  meant.body_b = 1;
  meant.enabled = false;
  builder.scene.pairs.push_back(meant);
  EXPECT_TRUE(warningsOf(builder).empty());
  expectOne(stackOf({1.0, 1.0, 1.0, 1.0, 1.0}), "'box0' and 'box4' and 3 more; add");
}

std::vector<std::string> unheldIn(const SceneBuilder& builder) {
  return detail::warnOfUnheldBodies(builder.scene, builder.settings);
}

TEST(UnheldBodies, ASimulationSaysSo) {
  SceneBuilder builder = stackOf({1.0});
  builder.scene.pairs.edit(0).enabled = false;
  EXPECT_EQ(builder.simulation().warnings(), unheldIn(builder));
}

TEST(UnheldBodies, AStackOnAFloorIsHeldOverAllItsBoxes) {
  EXPECT_TRUE(unheldIn(stackOf({1.0, 1.0, 1.0})).empty());
}

TEST(UnheldBodies, WhatHangsOnNothingIsNamedWithARemedy) {
  SceneBuilder builder = stackOf({1.0, 1.0, 1.0});
  builder.scene.pairs.edit(1).settings.effects.normal_force.reset();  // box0/box1
  builder.settings.bodies[2].where = "scene.yaml:7, simulation.bodies[2]";
  const std::vector<std::string> warnings = unheldIn(builder);
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_EQ(
      warnings[0],
      "scene.yaml:7, simulation.bodies[2]: body 'box1' falls for good: no enabled pair with a normal_force "
      "leads to a body that is held; give such a pair `effects: {normal_force: ...}`, give the body a "
      "drive, or fix it");
  EXPECT_EQ(warnings[1].substr(0, 28), "body 'box2' falls for good: ");
}

TEST(UnheldBodies, ADisabledPairHoldsNothing) {
  SceneBuilder builder = stackOf({1.0});
  builder.scene.pairs.edit(0).enabled = false;
  EXPECT_EQ(unheldIn(builder).size(), 1U);
}

TEST(UnheldBodies, AnOpenSurfaceHoldsNothing) {
  SceneBuilder builder;
  builder.addBody("sheet", test::makeOpened(makeBox({1.0, 1.0, 0.1}), 0));
  builder.addBody("box", makeBox({0.1, 0.1, 0.1}));
  builder.addPair().effects.normal_force.emplace();
  builder.setFree("box", 1.0).pose = test::at(0.0, 0.0, 1.0);
  EXPECT_EQ(unheldIn(builder).size(), 1U);
}

TEST(UnheldBodies, ADriveOrALoadHoldsABodyAndWhatStandsOnIt) {
  SceneBuilder builder = stackOf({1.0, 1.0});
  builder.scene.pairs.edit(0).enabled = false;
  EXPECT_EQ(unheldIn(builder).size(), 2U);
  builder.settings.bodies[1].loads.emplace_back();
  EXPECT_TRUE(unheldIn(builder).empty());
  builder.settings.bodies[1].loads.clear();
  builder.settings.bodies[1].drive.emplace();
  builder.settings.bodies[1].drive->target = {{0.0, Eigen::Isometry3d::Identity()}};
  EXPECT_TRUE(unheldIn(builder).empty());
}

TEST(UnheldBodies, WithoutGravityNothingFalls) {
  SceneBuilder builder = stackOf({1.0});
  builder.scene.pairs.edit(0).enabled = false;
  builder.settings.gravity.setZero();
  EXPECT_TRUE(unheldIn(builder).empty());
}

}  // namespace
}  // namespace concave_distance::suspicious_start_test
