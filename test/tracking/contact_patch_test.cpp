// Pressure over the surfaces of an overlap, with torque and friction, against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "effect_scene.h"
#include "support/concave_shapes.h"

namespace concave_distance {
namespace {

using test::at;
using test::body;
using test::EffectScene;

constexpr double kPi = 3.14159265358979323846;

EffectSettings foundation(double stiffness, FrictionModel friction = FrictionModel::None) {
  EffectSettings settings;
  settings.normal_force.emplace();
  settings.normal_force->model = NormalForceModel::ElasticFoundation;
  settings.normal_force->foundation_stiffness = stiffness;
  settings.friction.model = friction;
  return settings;
}

TEST(ContactPatch, ATiltedBoxIsTurnedUpright) {
  EffectScene scene(body("plate", makeBox({1, 1, 0.2})), body("box", makeBox({0.1, 0.1, 0.1})),
                    foundation(1e9));
  const double depth = 1e-4;
  const double tilt = 1e-4;
  Eigen::Isometry3d pose = at(0.0, 0.0, 0.15 - depth);
  pose.rotate(Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitX()));
  scene.update(pose);
  ASSERT_EQ(scene.contacts.regions.size(), 1U);
  // Springs side by side: k A d, and against the tilt k tilt w^4 / 12.
  const Wrench& wrench = scene.contacts.on_b_in_a;
  EXPECT_NEAR(wrench.force.z(), 1e9 * 0.01 * depth, 5.0);
  EXPECT_NEAR(wrench.torque.x(), -1e9 * tilt * std::pow(0.1, 4) / 12.0, 0.02);
  EXPECT_NEAR(scene.contacts.regions[0].largest_pressure, 1e9 * (depth + tilt * 0.05), 2e3);
}

TEST(ContactPatch, ADiscThatSpinsIsHeldBackByTwoThirdsOfItsRadius) {
  const double radius = 0.05;
  for (const FrictionModel model : {FrictionModel::RegularisedCoulomb, FrictionModel::Bristle}) {
    EffectScene scene(body("plate", makeBox({1, 1, 0.2})), body("disc", makeCylinder(radius, 0.02, 1e-5)),
                      foundation(1e9, model));
    RelativeTwist spin;
    spin.angular.z() = 10.0;
    for (int k = 0; k < 20; ++k) {
      Eigen::Isometry3d pose = at(0.0, 0.0, 0.11 - 1e-5);
      pose.rotate(Eigen::AngleAxisd(0.01 * k, Eigen::Vector3d::UnitZ()));
      scene.update(pose, 1e-3, spin);
    }
    const double force = scene.contacts.regions[0].normal_force;
    const double expected = 2.0 / 3.0 * Material().dynamic_friction * force * radius;
    EXPECT_NEAR(scene.contacts.on_b_in_a.torque.z(), -expected, 0.03 * expected) << toString(model);
    // What does not cancel comes from the sites' size.
    EXPECT_LT(scene.contacts.regions[0].friction_on_b_in_a.norm() * radius, 0.1 * expected)
        << toString(model);
  }
}

TEST(ContactPatch, AThinWallPushesTheBallBackTheWayItCameIn) {
  const double thickness = 1e-3;
  EffectScene scene(body("wall", makeBox({1, 1, thickness})), body("ball", makeSphere(0.025, 1e-5)),
                    foundation(1e11));
  double last = 0.0;
  for (int k = 0; k < 40; ++k) {
    const double depth = 1e-4 * (k + 0.5);
    scene.update(at(0.003, 0.002, 0.5 * thickness + 0.025 - depth));
    ASSERT_EQ(scene.contacts.regions.size(), 1U) << depth;
    EXPECT_GT(scene.contacts.on_b_in_a.force.z(), last) << depth;
    EXPECT_GT(scene.contacts.regions[0].overlap.normal_in_a.z(), 0.9) << depth;
    last = scene.contacts.on_b_in_a.force.z();
  }
}

TEST(ContactPatch, ATightPegIsPressedFromAllSidesAndNotPushedOut) {
  const auto plate = body("plate", test::makePlateWithHole(0.05, 0.01, 0.02, 256));
  EffectScene scene(plate, body("peg", makeCylinder(0.01005, 0.06, 1e-6)), foundation(1e12));
  scene.update(at(0.0, 0.0, 0.0));
  ASSERT_EQ(scene.contacts.regions.size(), 1U);
  const ContactRegion& region = scene.contacts.regions[0];
  EXPECT_NEAR(region.overlap.depth, 5e-5, 5e-6);
  EXPECT_NEAR(region.largest_pressure, 1e12 * 5e-5, 1e12 * 5e-6);
  const double all = 1e12 * 5e-5 * 2.0 * kPi * 0.01 * 0.02;
  EXPECT_LT(region.normal_force, 0.02 * all);
}

TEST(ContactPatch, TheLinearisationIsTheDerivativeOfTheWrench) {
  EffectScene scene(body("plate", makeBox({1, 1, 0.2})), body("box", makeBox({0.1, 0.1, 0.1})),
                    foundation(1e9));
  const Eigen::Isometry3d pose = at(0.0, 0.0, 0.15 - 1e-4);
  scene.update(pose);
  const ContactLinearisation linearisation = scene.contacts.linearisation;
  const Wrench before = scene.contacts.on_b_in_a;
  const double way = 1e-6;
  scene.update(at(0.0, 0.0, -way) * pose);
  EXPECT_NEAR((scene.contacts.on_b_in_a.force.z() - before.force.z()) / way, linearisation.stiffness(2, 2),
              0.02 * linearisation.stiffness(2, 2));
  scene.update(Eigen::Isometry3d(Eigen::AngleAxisd(way, Eigen::Vector3d::UnitX())) * pose);
  EXPECT_NEAR(-(scene.contacts.on_b_in_a.torque.x() - before.torque.x()) / way, linearisation.stiffness(3, 3),
              0.1 * linearisation.stiffness(3, 3));
}

}  // namespace
}  // namespace concave_distance
