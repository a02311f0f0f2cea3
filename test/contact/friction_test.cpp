#include "concave_distance/contact/friction.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/constants.h"
#include "concave_distance/base/error.h"
#include "contact/friction_sites.h"

namespace concave_distance::friction_test {
namespace {

const ContactMaterial kMaterial{1e9, 0.1, 0.6, 0.4, 0.0};
const Eigen::Vector3d kUp = Eigen::Vector3d::UnitZ();

TEST(Friction, CoefficientFallsFromStaticToDynamic) {
  EXPECT_DOUBLE_EQ(frictionCoefficient(kMaterial, 0.01, 0.0), 0.6);
  EXPECT_NEAR(frictionCoefficient(kMaterial, 0.01, 0.01), 0.4 + 0.2 * std::exp(-1.0), 1e-15);
  EXPECT_DOUBLE_EQ(frictionCoefficient(kMaterial, 0.01, 1.0), 0.4);
}

TEST(Friction, RegularisedCoulombOpposesTheMotionAndStaysBelowTheCone) {
  const FrictionSettings settings;
  for (const double speed : {1e-6, 1e-3, 0.1, 10.0}) {
    const Eigen::Vector3d sliding = speed * Eigen::Vector3d(0.6, -0.8, 0.0);
    const Eigen::Vector3d force = regularisedCoulombForce(settings, kMaterial, 100.0, sliding);
    EXPECT_LT(force.dot(sliding), 0.0);
    EXPECT_LE(force.norm(), 60.0 * (1.0 + 1e-12));
    EXPECT_LT(force.cross(sliding).norm(), 1e-12 * force.norm() * speed + 1e-30);
  }
  EXPECT_EQ(regularisedCoulombForce(settings, kMaterial, 100.0, Eigen::Vector3d::Zero()).norm(), 0.0);
  EXPECT_NEAR(regularisedCoulombForce(settings, kMaterial, 100.0, {1.0, 0.0, 0.0}).x(), -40.0, 1e-4);
}

TEST(Friction, BristlesEndInCoulombsForceWhileSliding) {
  const FrictionSettings settings;
  BristleState state;
  Eigen::Vector3d force;
  for (int k = 0; k < 2000; ++k) {
    force = bristleForce(settings, kMaterial, 100.0, kUp, {0.2, 0.0, 0.0}, {0.2e-4, 0.0, 0.0}, state);
  }
  EXPECT_NEAR(force.x(), -40.0, 1e-9);
  EXPECT_NEAR(state.deflection.x(), 0.4 / settings.bristle_stiffness, 1e-12);
}

/// A block pushed along a plane by a force that has risen to `push` after half a second (applied at
/// once it would throw the block over the bristles), integrated semi-implicitly: the way after a second.
double wayUnder(double push, double normal_force, double mass, FrictionModel model) {
  FrictionSettings settings;
  BristleState state;
  double speed = 0.0;
  double displacement = 0.0;
  const double step = 1e-5;
  for (int k = 0; k < 100000; ++k) {
    const Eigen::Vector3d sliding(speed, 0.0, 0.0);
    const Eigen::Vector3d force =
        model == FrictionModel::Bristle
            ? bristleForce(settings, kMaterial, normal_force, kUp, sliding, step * sliding, state)
            : regularisedCoulombForce(settings, kMaterial, normal_force, sliding);
    speed += step * (0.5 * (1.0 - std::cos(kPi * std::min(1.0, k / 50000.0))) * push + force.x()) / mass;
    displacement += step * speed;
  }
  return displacement;
}

TEST(Friction, BristlesStickBelowTheStaticLimitAndSlideAboveIt) {
  // The limit is 0.6 * 20 = 12 N. Up to 0.7 of it the block gives way by as much as its bristles bend.
  for (const double push : {3.0, 6.0, 8.0}) {
    const double closed_form = 0.6 / 1e4 * push / 12.0;
    EXPECT_NEAR(wayUnder(push, 20.0, 2.0, FrictionModel::Bristle), closed_form, 0.02 * closed_form);
  }
  EXPECT_GT(wayUnder(12.5, 20.0, 2.0, FrictionModel::Bristle), 0.1);
}

TEST(Friction, RegularisedCoulombCreepsWhereBristlesStick) {
  const double creep = wayUnder(11.5, 20.0, 2.0, FrictionModel::RegularisedCoulomb);
  EXPECT_GT(creep, 1e-3);
}

TEST(Friction, TheRuleIsStableAtAnyStep) {
  const FrictionSettings settings;
  for (const double step : {1e-6, 1e-3, 1.0, 1e6}) {
    BristleState state;
    for (int k = 0; k < 50; ++k) {
      const double speed = k % 2 == 0 ? 3.0 : -3.0;
      const Eigen::Vector3d force =
          bristleForce(settings, kMaterial, 10.0, kUp, {speed, 0.0, 0.0}, {step * speed, 0.0, 0.0}, state);
      EXPECT_LE(force.norm(), 6.0 * (1.0 + 1e-12));
      EXPECT_LE(state.deflection.norm(), 0.6 / settings.bristle_stiffness * (1.0 + 1e-12));
    }
  }
}

TEST(Friction, BristlesTurnWithTheirPlaneAndKeepTheirLength) {
  const FrictionSettings settings;
  BristleState state;
  state.deflection = {1e-5, 0.0, 0.0};
  const Eigen::Vector3d tilted = Eigen::Vector3d(0.3, 0.0, 1.0).normalized();
  bristleForce(settings, kMaterial, 10.0, tilted, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), state);
  EXPECT_NEAR(state.deflection.norm(), 1e-5, 1e-20);
  EXPECT_NEAR(state.deflection.dot(tilted), 0.0, 1e-20);
}

TEST(Friction, WithoutLoadBristlesForget) {
  const FrictionSettings settings;
  BristleState state;
  state.deflection = {1e-5, 0.0, 0.0};
  EXPECT_EQ(bristleForce(settings, kMaterial, 0.0, kUp, {1.0, 0.0, 0.0}, {1e-3, 0.0, 0.0}, state).norm(),
            0.0);
  EXPECT_EQ(state.deflection.norm(), 0.0);
}

TEST(Friction, OverACycleNothingIsGained) {
  const FrictionSettings settings;
  BristleState state;
  double work = 0.0;
  const double step = 1e-5;
  for (int k = 0; k < 40000; ++k) {
    const Eigen::Vector3d sliding(0.05 * std::sin(k * 1e-3), 0.02 * std::cos(k * 7e-4), 0.0);
    work += step * bristleForce(settings, kMaterial, 10.0, kUp, sliding, step * sliding, state).dot(sliding);
  }
  EXPECT_LT(work, 0.0);
}

TEST(Friction, ParametersOutOfRangeAreNamed) {
  FrictionSettings settings;
  settings.bristle_stiffness = 0.0;
  try {
    settings.validate("pairs.friction");
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "pairs.friction: bristle_stiffness is 0 (allowed: greater than 0 (1/m))");
  }
}

/// As a triangle of a mesh is sampled that lies whole in the overlap: at the middles of its edges.
std::vector<OverlapSample> samplesOf(const Eigen::Vector3d& p, const Eigen::Vector3d& q,
                                     const Eigen::Vector3d& r) {
  const double area = 0.25 * (q - p).cross(r - p).norm();  // half of it: both surfaces count half
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  std::vector<OverlapSample> samples;
  for (const Eigen::Vector3d& sum : {Eigen::Vector3d(p + q), Eigen::Vector3d(q + r), Eigen::Vector3d(r + p)})
    samples.push_back({0.5 * sum, up, up, area / 3.0, 1e-3});
  return samples;
}

TEST(FrictionSites, ATriangleIsSpreadOverTheCellsThatItCovers) {
  const std::vector<OverlapSample> samples = samplesOf({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  FrictionSites sites;
  sites.gather(samples.data(), samples.data() + samples.size(), {1.0, 1.0, 1.0}, 0.2);
  double force = 0.0;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  for (const FrictionSite& site : sites.all()) {
    EXPECT_GT(site.force, 0.0);
    EXPECT_LT(site.spread, 0.2);
    force += site.force;
    place += site.force * site.point_in_a;
  }
  EXPECT_GT(sites.all().size(), 10U);
  EXPECT_NEAR(force, 3.0, 1e-12);
  EXPECT_NEAR((place / force - Eigen::Vector3d(1.0 / 3.0, 1.0 / 3.0, 0.0)).norm(), 0.0, 1e-12);
}

// A cylinder that hardly touches a plane: cells as wide as the strip, which is a million times as long.
TEST(FrictionSites, AStripHasFewSites) {
  for (const double width : {1e-6, 1e-9, 1e-12, 1e-15}) {
    const std::vector<OverlapSample> samples = samplesOf({0, 0, 0}, {1, 0, 0}, {0.5, width, 0});
    FrictionSites sites;
    sites.gather(samples.data(), samples.data() + samples.size(), {1.0, 1.0, 1.0}, 0.1 * width);
    double force = 0.0;
    for (const FrictionSite& site : sites.all()) force += site.force;
    EXPECT_NEAR(force, 3.0, 1e-9) << width;
    EXPECT_LT(sites.all().size(), 40U) << width;
  }
}

}  // namespace
}  // namespace concave_distance::friction_test
