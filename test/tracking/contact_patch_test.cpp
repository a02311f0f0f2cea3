// Pressure over the surfaces of an overlap, with torque and friction, against closed forms.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <string>
#include <utility>

#include "base/constants.h"
#include "effect_scene.h"
#include "support/concave_shapes.h"

namespace concave_distance::contact_patch_test {
namespace {

using test::at;
using test::body;
using test::EffectScene;

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

/// Friction on a flat body, pressed evenly on a plate, that slides along x and spins about z at the same
/// time.
struct FlatFriction {
  double force;   ///< along x, over the greatest
  double torque;  ///< about z, over the greatest force, metres
};

FlatFriction frictionOf(SurfaceMesh mesh, double half_height, FrictionModel model, double speed,
                        double spin) {
  EffectScene scene(body("plate", makeBox({1, 1, 0.2})), body("flat", std::move(mesh)),
                    foundation(1e9, model));
  const double step = 1e-3;
  for (int k = -20; k <= 0; ++k) {
    const Eigen::Vector3d place(step * speed * k, 0.0, 0.1 + half_height - 1e-5);
    Eigen::Isometry3d pose = at(place.x(), place.y(), place.z());
    pose.rotate(Eigen::AngleAxisd(step * spin * k, Eigen::Vector3d::UnitZ()));
    RelativeTwist twist;
    twist.angular.z() = spin;
    twist.linear = Eigen::Vector3d(speed, 0.0, 0.0) - twist.angular.cross(place);
    scene.update(pose, step, twist);
  }
  const double greatest = Material().dynamic_friction * scene.contacts.regions[0].normal_force;
  return {-scene.contacts.on_b_in_a.force.x() / greatest, -scene.contacts.on_b_in_a.torque.z() / greatest};
}

/// Sums over a grid of cells whose middle is inside.
template <typename Inside>
FlatFriction summed(double half_width, double speed, double spin, const Inside& inside) {
  const int count = 1000;
  FlatFriction sum{0.0, 0.0};
  int cells = 0;
  for (int i = 0; i < count * count; ++i) {
    const double x = half_width * (2.0 * (i % count + 0.5) / count - 1.0);
    const double y = half_width * (2.0 * (i / count + 0.5) / count - 1.0);
    if (!inside(x, y)) continue;
    const double along = speed - spin * y;
    const double across = spin * x;
    const double size = std::hypot(along, across);
    sum.force += along / size;
    sum.torque += (x * across - y * along) / size;
    ++cells;
  }
  return {sum.force / cells, sum.torque / cells};
}

constexpr double kHalf = 0.05;                 // metres: half of a face's width
constexpr double kDrifts[] = {0.0, 0.2, 1.0};  // sliding over spinning at the rim

class FlatFaces : public testing::TestWithParam<FrictionModel> {};

TEST_P(FlatFaces, ADiscThatSpinsAndSlidesIsHeldBackAsTheIntegralSays) {
  EXPECT_NEAR(frictionOf(makeCylinder(kHalf, 0.02, 1e-4), 0.01, GetParam(), 0.0, 10.0).torque,
              2.0 / 3.0 * kHalf, 0.02 * 2.0 / 3.0 * kHalf);
  for (const double drift : kDrifts) {
    const double speed = drift * 10.0 * kHalf;
    const FlatFriction found = frictionOf(makeCylinder(kHalf, 0.02, 1e-5), 0.01, GetParam(), speed, 10.0);
    const FlatFriction expected =
        summed(kHalf, speed, 10.0, [](double x, double y) { return std::hypot(x, y) < kHalf; });
    EXPECT_NEAR(found.torque, expected.torque, 0.03 * kHalf) << drift;
    EXPECT_NEAR(found.force, expected.force, 0.05) << drift;
  }
}

TEST_P(FlatFaces, ABoxThatSpinsAndSlidesIsHeldBackAsTheIntegralSays) {
  for (const double drift : kDrifts) {
    const double speed = drift * 10.0 * kHalf;
    const FlatFriction found =
        frictionOf(makeBox({2.0 * kHalf, 2.0 * kHalf, 0.02}), 0.01, GetParam(), speed, 10.0);
    const FlatFriction expected = summed(kHalf, speed, 10.0, [](double, double) { return true; });
    EXPECT_NEAR(found.torque, expected.torque, 0.03 * kHalf) << drift;
    EXPECT_NEAR(found.force, expected.force, 0.05) << drift;
  }
}

INSTANTIATE_TEST_SUITE_P(ContactPatch, FlatFaces,
                         testing::Values(FrictionModel::RegularisedCoulomb, FrictionModel::Bristle),
                         [](const auto& info) { return std::string(toString(info.param)); });

TEST(ContactPatch, FrictionOfAFaceHasATangentThatIsNotNegative) {
  for (const FrictionModel model : {FrictionModel::RegularisedCoulomb, FrictionModel::Bristle}) {
    EffectScene scene(body("plate", makeBox({1, 1, 0.2})), body("box", makeBox({0.1, 0.1, 0.1})),
                      foundation(1e9, model));
    for (const double spin : {0.0, 1e-6, 1e-3, 1.0}) {
      RelativeTwist twist;
      twist.linear.x() = 0.02 * spin;
      twist.angular.z() = spin;
      for (int k = 0; k < 3; ++k) scene.update(at(0.02 * spin * 1e-3 * k, 0.0, 0.15 - 1e-4), 1e-3, twist);
      for (const Matrix6d& part :
           {scene.contacts.linearisation.stiffness, scene.contacts.linearisation.damping}) {
        const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(part);
        EXPECT_GE(solver.eigenvalues().minCoeff(), -1e-12 * solver.eigenvalues().maxCoeff())
            << toString(model) << " " << spin;
      }
    }
  }
}

TEST(ContactPatch, DampingTakesEnergyWhereABallComesThroughAThinWall) {
  const double thickness = 1e-3;
  EffectSettings settings = foundation(1e10);
  settings.normal_force->model = NormalForceModel::HuntCrossley;
  EffectScene scene(body("wall", makeBox({1, 1, thickness})), body("ball", makeSphere(0.05, 5e-4)), settings);
  RelativeTwist twist;
  twist.linear.z() = -1.0;
  const double rate = 1.5 * Material().dissipation;
  for (const double depth : {2e-4, 6e-4, 1.2e-3, 2e-3}) {
    const Eigen::Isometry3d pose = at(0.003, 0.002, 0.5 * thickness + 0.05 - depth);
    scene.update(pose, 0.0);
    const double still = scene.contacts.on_b_in_a.force.z();
    scene.update(pose, 0.0, twist);
    // By place: less where the ball's surface is steep.
    const double share = (scene.contacts.on_b_in_a.force.z() / still - 1.0) / rate;
    EXPECT_LE(share, 1.0 + 1e-9) << depth;
    EXPECT_GE(share, 1.0 - 2.0 * depth / 0.05 - 0.02) << depth;
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

/// How the force on B changes along a way, and what the linearisation says.
struct Slope {
  double measured;
  double predicted;
};

Slope slopeOf(EffectScene& scene, const Eigen::Isometry3d& pose, const Eigen::Vector3d& along, double way) {
  const auto force = [&](double shift) {
    scene.update(Eigen::Translation3d(shift * along) * pose, 0.0);
    return scene.contacts.on_b_in_a.force.dot(along);
  };
  const double measured = (force(-way) - force(way)) / (2.0 * way);
  scene.update(pose, 0.0);
  const Matrix6d& stiffness = scene.contacts.linearisation.stiffness;
  return {measured, along.dot(stiffness.topLeftCorner<3, 3>() * along)};
}

EffectSettings undamped(NormalForceModel model) {
  EffectSettings settings = foundation(1e10);
  settings.normal_force->model = model;
  return settings;
}

class EveryLaw : public testing::TestWithParam<NormalForceModel> {};

TEST_P(EveryLaw, TheStiffnessIsTheForcesDerivativeForRoundAndFlatContactAndAPressFit) {
  // A quasi-static force counts as if its area grew as a ball's: on a face it is stiffer than it is.
  const double too_stiff = GetParam() == NormalForceModel::QuasiStatic ? 0.3 : 0.07;
  const auto expect = [&](EffectScene& scene, const Eigen::Isometry3d& pose, const Eigen::Vector3d& along) {
    const Slope slope = slopeOf(scene, pose, along, 1e-8);
    EXPECT_GT(slope.predicted, 0.9 * slope.measured);
    EXPECT_LT(slope.predicted, (1.0 + too_stiff) * slope.measured);
  };
  const auto plate = body("plate", makeBox({1, 1, 0.2}));
  EffectScene box(plate, body("box", makeBox({0.1, 0.1, 0.1})), undamped(GetParam()));
  EffectScene ball(plate, body("ball", makeSphere(0.05, 1e-5)), undamped(GetParam()));
  for (const double depth : {1e-4, 3e-4, 1e-3}) {
    SCOPED_TRACE(depth);
    expect(box, at(0.0, 0.0, 0.15 - depth), Eigen::Vector3d::UnitZ());
    expect(ball, at(0.0012, 0.0007, 0.15 - depth), Eigen::Vector3d::UnitZ());
  }
  EffectScene peg(body("plate", test::makePlateWithHole(0.03, 0.01, 0.02, 96)),
                  body("peg", makeCylinder(0.01005, 0.04, 5e-6)), undamped(GetParam()));
  for (const double shift : {2e-5, 6e-5, 1.5e-4}) {
    SCOPED_TRACE(shift);
    expect(peg, at(shift, 0.0, 0.01), Eigen::Vector3d::UnitX());
  }
}
INSTANTIATE_TEST_SUITE_P(ContactPatch, EveryLaw,
                         testing::Values(NormalForceModel::ElasticFoundation, NormalForceModel::HuntCrossley,
                                         NormalForceModel::Hertz, NormalForceModel::QuasiStatic,
                                         NormalForceModel::SpringDashpot));

// What is decided by rounding must not be seen in the force: a step of a tenth of a nanometre changes it by
// a millionth, and what rounding changed would be seen as a jump.
TEST(ContactPatch, TheForceOfATessellatedBallChangesAsItsStiffnessSaysInTheSmallestSteps) {
  EffectScene scene(body("plate", makeBox({1, 1, 0.2})), body("ball", makeSphere(0.05, 1e-5)),
                    foundation(1e10));
  const double way = 1e-10;
  for (int i = 0; i < 24; ++i) {
    const Slope slope =
        slopeOf(scene, at(0.0012, 0.0007, 0.15 - 3e-4 - i * way), Eigen::Vector3d::UnitZ(), way);
    EXPECT_NEAR(slope.measured, slope.predicted, 0.05 * slope.predicted) << i;
  }
}

// So shallow that what happens at the bumps' edges does not count.
constexpr double kLedge = 2e-5;
constexpr double kShallow = 1e-5;             // two regions
constexpr double kDeep = 1.001 * kLedge;      // one: the ledge bears less than 1e-3 of the load
constexpr double kShift = 1e-5;               // bends the bristles to 0.2 of what they bear
constexpr double kBumps = 2.0 * 0.02 * 0.03;  // m^2
constexpr double kStiff = 1e11;               // Pa/m

/// A bar along y with two flat bumps, 20 mm wide and 40 mm apart, and between them a ledge that much lower.
SurfaceMesh bumpyBar(double ledge) {
  const SurfaceMesh profile = test::makeExtrusion({{-0.03, -0.02},
                                                   {0.03, -0.02},
                                                   {0.03, 0.0},
                                                   {0.01, 0.0},
                                                   {0.01, -ledge},
                                                   {-0.01, -ledge},
                                                   {-0.01, 0.0},
                                                   {-0.03, 0.0}},
                                                  0.04);
  std::vector<Eigen::Vector3d> vertices;
  for (const Eigen::Vector3d& v : profile.vertices()) vertices.emplace_back(v.x(), -v.z(), v.y());
  return SurfaceMesh(std::move(vertices), profile.triangles(), "bumpy bar");
}

/// A block on the bar, `depth` below the tops of the bumps, `shift` along x.
struct BridgedBumps {
  EffectScene scene{body("bar", bumpyBar(kLedge)), body("block", makeBox({0.2, 0.03, 0.02})),
                    foundation(kStiff, FrictionModel::Bristle)};
  double depth = 0.0;
  double shift = 0.0;

  void goTo(double new_depth, double new_shift) {
    RelativeTwist twist;
    twist.linear = Eigen::Vector3d(new_shift - shift, 0.0, depth - new_depth) / 0.01;
    depth = new_depth;
    shift = new_shift;
    scene.update(at(shift, 0.0, 0.01 - depth), 0.01, twist);
    twist.linear.setZero();
    scene.update(at(shift, 0.0, 0.01 - depth), 0.01, twist);  // at rest: without the bristles' damping
  }
  std::size_t regions() const { return scene.contacts.regions.size(); }
  double friction() const { return -scene.contacts.on_b_in_a.force.x(); }
};

/// sigma_0 z N of bristles that were bent by kShift, whatever the regions did in between.
double frictionAt(double depth) {
  return FrictionSettings().bristle_stiffness * kShift * kStiff * kBumps * depth;
}

TEST(ContactPatch, BristlesGoOnWhenARegionSplits) {
  BridgedBumps bumps;
  bumps.goTo(kDeep, 0.0);
  bumps.goTo(kDeep, kShift);
  ASSERT_EQ(bumps.regions(), 1U);
  EXPECT_NEAR(bumps.friction(), frictionAt(kDeep), 5e-3 * frictionAt(kDeep));
  bumps.goTo(kShallow, kShift);
  ASSERT_EQ(bumps.regions(), 2U);
  EXPECT_NEAR(bumps.friction(), frictionAt(kShallow), 5e-3 * frictionAt(kShallow));
}

TEST(ContactPatch, BristlesGoOnWhenRegionsBecomeOne) {
  BridgedBumps bumps;
  bumps.goTo(kShallow, 0.0);
  bumps.goTo(kShallow, kShift);
  ASSERT_EQ(bumps.regions(), 2U);
  bumps.goTo(kDeep, kShift);
  ASSERT_EQ(bumps.regions(), 1U);
  EXPECT_NEAR(bumps.friction(), frictionAt(kDeep), 5e-3 * frictionAt(kDeep));
}

// A tilted block touches one bump first and rubs there before it touches the other.
TEST(ContactPatch, ANewRegionBesideAKnownOneHasNoBristles) {
  EffectScene scene(body("bar", bumpyBar(1e-3)), body("block", makeBox({0.2, 0.03, 0.02})),
                    foundation(1e9, FrictionModel::Bristle));
  const auto pose = [](double depth, double shift) {
    return at(shift, 0.0, 0.0) * Eigen::AngleAxisd(5e-3, Eigen::Vector3d::UnitY()) *
           at(0.0, 0.0, 0.01 - depth);
  };
  scene.update(pose(0.0, 0.0));
  scene.update(pose(0.0, kShift));
  scene.update(pose(0.0, kShift));
  ASSERT_EQ(scene.contacts.regions.size(), 1U);
  scene.update(pose(8e-5, kShift));
  ASSERT_EQ(scene.contacts.regions.size(), 2U);
  for (const ContactRegion& region : scene.contacts.regions) {
    const double bent =
        -region.friction_on_b_in_a.x() / region.normal_force / FrictionSettings().bristle_stiffness;
    EXPECT_NEAR(bent, region.point_in_a.x() > 0.0 ? kShift : 0.0, 0.2 * kShift) << region.point_in_a.x();
  }
}

}  // namespace
}  // namespace concave_distance::contact_patch_test
