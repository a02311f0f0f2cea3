#include <gtest/gtest.h>

#include <string>

#include "simulation/box_stack.h"
#include "simulation/unheld_bodies.h"
#include "support/plain_shapes.h"

namespace concave_distance::unheld_bodies_test {
namespace {

using test::SceneBuilder;
using test::stackOf;

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
}  // namespace concave_distance::unheld_bodies_test
