#include "concave_distance/tracking/pair_effects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/constants.h"
#include "concave_distance/contact/normal_force.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "support/concave_shapes.h"
#include "support/round_bodies.h"
#include "tracking/effect_scene.h"

namespace concave_distance::pair_effects_test {
namespace {

using test::at;
using test::body;
using test::EffectScene;
using test::spring;
using test::twoFeet;

EffectSettings onlyInterference() {
  EffectSettings settings;
  settings.interference = true;
  return settings;
}

std::uint64_t runs(const PairEffects& effects, EffectStage stage) {
  return effects.counts().runs[static_cast<std::size_t>(stage)];
}

TEST(PairEffects, NothingRunsWhileTheCertificateExcludesContact) {
  EffectScene scene(body("a", makeBox({1, 1, 1})), body("b", makeBox({1, 1, 1})), spring(1e4));
  for (const double gap : {1.0, 0.1, 1e-6}) {
    scene.update(at(0, 0, 1.0 + gap));
    EXPECT_FALSE(scene.contacts.possible) << gap;
    EXPECT_TRUE(scene.contacts.regions.empty());
  }
  for (const std::uint64_t count : scene.effects.counts().runs) EXPECT_EQ(count, 0U);
  EXPECT_EQ(scene.contacts.on_b_in_a.force.norm(), 0.0);
}

TEST(PairEffects, AStageThatIsNotAskedForNeverRuns) {
  EffectScene scene(body("a", makeBox({1, 1, 1})), body("b", makeBox({1, 1, 1})), onlyInterference());
  scene.update(at(0.1, 0.2, 0.99));
  EXPECT_EQ(runs(scene.effects, EffectStage::Interference), 1U);
  EXPECT_EQ(runs(scene.effects, EffectStage::Identity), 1U);
  EXPECT_EQ(runs(scene.effects, EffectStage::NormalForce), 0U);
  EXPECT_EQ(runs(scene.effects, EffectStage::Friction), 0U);
  ASSERT_EQ(scene.contacts.regions.size(), 1U);
  EXPECT_TRUE(std::isnan(scene.contacts.regions[0].normal_force));
  EXPECT_TRUE(std::isnan(scene.contacts.on_b_in_a.force.x()));
}

TEST(PairEffects, ASpringPushesInProportionToTheDepth) {
  EffectScene scene(body("a", makeBox({1, 1, 1})), body("b", makeBox({0.5, 0.5, 0.5})), spring(2e4));
  scene.update(at(0.1, 0.2, 0.74));
  ASSERT_EQ(scene.contacts.regions.size(), 1U);
  const ContactRegion& region = scene.contacts.regions[0];
  EXPECT_NEAR(region.overlap.depth, 0.01, 1e-12);
  EXPECT_NEAR(region.normal_force, 200.0, 1e-8);
  EXPECT_LT((scene.contacts.on_b_in_a.force - Eigen::Vector3d(0, 0, 200)).norm(), 1e-7);
  // About A's origin: the force acts under B's middle.
  EXPECT_LT((scene.contacts.on_b_in_a.torque - Eigen::Vector3d(40, -20, 0)).norm(), 1e-6);
}

TEST(PairEffects, FrictionRunsOnlyUnderLoad) {
  EffectScene scene(body("a", makeBox({1, 1, 1})), body("b", makeBox({0.5, 0.5, 0.5})),
                    spring(2e4, FrictionModel::RegularisedCoulomb));
  scene.effects.setSettings(
      [] {
        EffectSettings settings = spring(2e4, FrictionModel::RegularisedCoulomb);
        settings.normal_force->damping = 1e6;
        return settings;
      }(),
      inContact(Material(), Material()));
  RelativeTwist parting;
  parting.linear = {1.0, 0.0, 5.0};  // so fast that the damper would pull: no force
  scene.update(at(0, 0, 0.74), 0.01, parting);
  EXPECT_EQ(runs(scene.effects, EffectStage::NormalForce), 1U);
  EXPECT_EQ(runs(scene.effects, EffectStage::Friction), 0U);
  RelativeTwist sliding;
  sliding.linear = {1.0, 0.0, 0.0};
  scene.update(at(0, 0, 0.7399), 0.01, sliding);
  EXPECT_EQ(runs(scene.effects, EffectStage::Friction), 1U);
  EXPECT_NEAR(scene.contacts.regions[0].friction_on_b_in_a.x(), -0.4 * scene.contacts.regions[0].normal_force,
              1e-3);
}

TEST(PairEffects, ANicheKeepsItsIdThroughContactAndBack) {
  EffectScene scene(body("ground", makeBox({2, 2, 0.2})), body("feet", twoFeet()), spring(1e4));
  const auto tilted = [](double height, double angle) {
    return Eigen::Isometry3d(Eigen::Translation3d(0, 0, 0.2 + height) *
                             Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()));
  };
  // Down until the one foot is in the ground, then the other as well, then up again.
  for (int k = 0; k <= 20; ++k) scene.update(tilted(0.05 - 0.001 * k, 0.05));
  ASSERT_GE(scene.solution.niches.size(), 2U);
  const std::uint64_t first = scene.solution.niches[0].id;
  std::set<std::uint64_t> approaching;
  for (const TrackedNiche& niche : scene.solution.niches) approaching.insert(niche.id);
  int in_contact = 0;
  int both = 0;
  for (int k = 21; k <= 90; ++k) {
    scene.update(tilted(0.05 - 0.001 * k, 0.05));
    in_contact += scene.contacts.regions.empty() ? 0 : 1;
    both += scene.contacts.regions.size() == 2 ? 1 : 0;
    std::set<std::uint64_t> ids;
    for (const ContactRegion& region : scene.contacts.regions) ids.insert(region.id);
    EXPECT_EQ(ids.size(), scene.contacts.regions.size()) << "a region without an id of its own, step " << k;
    if (scene.contacts.regions.size() == 1) {
      EXPECT_EQ(*ids.begin(), first) << "step " << k;
    }
    for (const std::uint64_t id : ids) EXPECT_EQ(approaching.count(id), 1U) << "a new id at step " << k;
  }
  EXPECT_GT(in_contact, 30);
  EXPECT_GT(both, 5);
  for (int k = 90; k >= 0; --k) scene.update(tilted(0.05 - 0.001 * k, 0.05));
  EXPECT_TRUE(scene.contacts.regions.empty());
  ASSERT_FALSE(scene.solution.niches.empty());
  EXPECT_EQ(scene.solution.niches[0].id, first) << "the region has become another niche";
}

// The shape of config/peg_in_hole.yaml: the peg bears on several facets of the hole at once, each a region.
TEST(PairEffects, EveryRegionOfAPegInAHoleHasAnIdOfItsOwn) {
  EffectScene scene(body("plate", test::makePlateWithHole(0.04, 0.0205, 0.02, 24)),
                    test::makeRoundBody(test::roundShape(RoundKind::Cylinder, 0.02, 0.06, 1e-4)),
                    onlyInterference());
  std::size_t most = 0;
  for (int k = 0; k <= 60; ++k) {
    // Askew and to one side.
    scene.update(Eigen::Isometry3d(Eigen::Translation3d(-0.0006 + 0.0004 * k / 60.0, 1e-5, 0.03) *
                                   Eigen::AngleAxisd(-0.02, Eigen::Vector3d::UnitY())));
    std::set<std::uint64_t> ids;
    for (const ContactRegion& region : scene.contacts.regions) {
      EXPECT_NE(region.id, 0U) << "step " << k;
      ids.insert(region.id);
    }
    EXPECT_EQ(ids.size(), scene.contacts.regions.size()) << "step " << k;
    most = std::max(most, ids.size());
  }
  EXPECT_GE(most, 4U);
}

TEST(PairEffects, BristlesOfARegionGoOnFromCycleToCycle) {
  EffectScene scene(body("a", makeBox({2, 2, 1})), body("b", makeBox({0.5, 0.5, 0.5})),
                    spring(1e6, FrictionModel::Bristle));
  RelativeTwist sliding;
  sliding.linear = {1e-4, 0.0, 0.0};
  double before = 0.0;
  for (int k = 0; k < 20; ++k) {
    scene.update(at(1e-6 * k, 0, 0.7499), 0.01, sliding);
    ASSERT_EQ(scene.contacts.regions.size(), 1U);
    const double friction = -scene.contacts.regions[0].friction_on_b_in_a.x();
    EXPECT_GT(friction, before) << "the bristles do not bend on, step " << k;
    before = friction;
  }
  // Switched off and on again they stand upright.
  scene.effects.setSettings(spring(1e6), inContact(Material(), Material()));
  scene.update(at(2e-5, 0, 0.7499), 0.01, sliding);
  EXPECT_TRUE(std::isnan(scene.contacts.regions[0].friction_on_b_in_a.x()));
  scene.effects.setSettings(spring(1e6, FrictionModel::Bristle), inContact(Material(), Material()));
  scene.update(at(2e-5, 0, 0.7499), 0.01, sliding);
  EXPECT_LT(-scene.contacts.regions[0].friction_on_b_in_a.x(), before);
}

TEST(PairEffects, HertzianIndentationOfASphereIsWithinItsTessellation) {
  const double radius = 0.1;
  const auto plane = body("plane", makeBox({1, 1, 0.2}));
  const auto ball = body("ball", makeSphere(radius, 1e-5));
  EffectSettings settings;
  settings.normal_force.emplace();
  settings.normal_force->model = NormalForceModel::Hertz;
  PairTracker tracker("pair", plane, ball, TrackerParameters());
  PairEffects effects(plane, ball, settings, inContact(Material(), Material()));
  PairSolution solution;
  PairContacts contacts;
  const double depth = 1e-3;
  const Eigen::Isometry3d pose = at(0.0013, 0.0007, 0.1 + radius - depth);
  tracker.update(pose, 0.0, solution);
  effects.update(solution, {}, 0.0, contacts);
  ASSERT_EQ(contacts.regions.size(), 1U);
  const double expected = hertzForce(depth, inContact(Material(), Material()).contact_modulus, radius);
  EXPECT_NEAR(contacts.on_b_in_a.force.z(), expected, 0.02 * expected);
  EXPECT_NEAR(contacts.regions[0].overlap.contact_area, kPi * 2.0 * radius * depth,
              0.02 * kPi * 2.0 * radius * depth);
}

// A step that is tried again begins with the bristles of before.
TEST(PairEffects, GoingBackForgetsWhatCameSinceItWasKept) {
  EffectScene scene(body("a", makeBox({1, 1, 1})), body("b", makeBox({0.5, 0.5, 0.5})),
                    spring(2e4, FrictionModel::Bristle));
  scene.update(at(0, 0, 0.74));
  scene.update(at(1e-6, 0, 0.74));
  scene.effects.keep();
  scene.update(at(3e-6, 0, 0.74));
  const Eigen::Vector3d once = scene.contacts.on_b_in_a.force;
  scene.update(at(7e-6, 0, 0.74));
  EXPECT_LT(scene.contacts.on_b_in_a.force.x(), once.x());
  scene.effects.goBack();
  scene.update(at(3e-6, 0, 0.74));
  EXPECT_EQ(scene.contacts.on_b_in_a.force, once);
}

TEST(PairEffects, GoingBackBendsTheBristlesOfRollingAndSpinningBack) {
  EffectScene scene(body("a", makeBox({1, 1, 1})), body("b", makeBox({0.5, 0.5, 0.5})),
                    spring(2e4, FrictionModel::Bristle));
  Material carpet;
  carpet.rolling_friction = carpet.spinning_friction = 0.01;
  scene.effects.setSettings(scene.effects.settings(), inContact(carpet, carpet));
  const auto turned = [](double angle) {
    return at(0, 0, 0.74) * Eigen::AngleAxisd(angle, Eigen::Vector3d(0.6, 0.0, 0.8));
  };
  scene.update(turned(0.0));
  scene.update(turned(1e-7));
  scene.effects.keep();
  scene.update(turned(3e-7));
  const ContactRegion region = scene.contacts.regions.at(0);
  const Eigen::Vector3d once = region.rubbing_on_b_in_a.torque;
  // Torsional springs of sigma_0 R^2 a newton, R half of B's width, besides the friction at its point.
  const double stiffness = FrictionSettings().bristle_stiffness * 0.25 * 0.25 * region.normal_force;
  const Eigen::Vector3d turning = once - region.point_in_a.cross(region.friction_on_b_in_a);
  EXPECT_LT((turning + stiffness * 3e-7 * Eigen::Vector3d(0.6, 0.0, 0.8)).norm(), 1e-6 * stiffness * 3e-7);
  scene.update(turned(7e-7));
  EXPECT_LT(scene.contacts.regions.at(0).rubbing_on_b_in_a.torque.z(), once.z());
  scene.effects.goBack();
  scene.update(turned(3e-7));
  EXPECT_EQ(scene.contacts.regions.at(0).rubbing_on_b_in_a.torque, once);
}

TEST(PairEffects, ItsLinearisationIsThatOfItsWrench) {
  EffectScene scene(body("a", makeBox({1, 1, 1})), body("b", makeBox({0.5, 0.5, 0.5})),
                    spring(2e4, FrictionModel::Bristle));
  scene.update(at(0.1, 0.0, 0.75 + 1e-6));
  EXPECT_EQ(scene.contacts.linearisation.stiffness.norm(), 0.0);
  scene.update(at(0.1, 0.0, 0.74));
  const Vector6d before =
      (Vector6d() << scene.contacts.on_b_in_a.force, scene.contacts.on_b_in_a.torque).finished();
  const Matrix6d stiffness = scene.contacts.linearisation.stiffness;
  EXPECT_EQ((stiffness - stiffness.transpose()).norm(), 0.0);
  Vector6d shift = Vector6d::Zero();
  shift.head<3>() << 1e-8, 0.0, -2e-8;
  scene.update(at(0.1 + shift[0], 0.0, 0.74 + shift[2]));
  const Vector6d after =
      (Vector6d() << scene.contacts.on_b_in_a.force, scene.contacts.on_b_in_a.torque).finished();
  // The bristles give way by the share of their limit that they are bent: 2e-4.
  EXPECT_LT((after - before + stiffness * shift).head<3>().norm(), 1e-3 * (after - before).head<3>().norm());
}

}  // namespace
}  // namespace concave_distance::pair_effects_test
