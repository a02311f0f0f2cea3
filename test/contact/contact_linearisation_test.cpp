#include "concave_distance/contact/contact_linearisation.h"

#include <gtest/gtest.h>

#include "concave_distance/contact/friction.h"
#include "concave_distance/contact/normal_force.h"

namespace concave_distance::contact_linearisation_test {
namespace {

const ContactMaterial kElastic{1e9, 0.4, 0.6, 0.4, 0.0};
const Eigen::Vector3d kSurfaceNormal = Eigen::Vector3d::UnitZ();

TEST(ContactLinearisation, ADirectionResistsAsASpringAtItsPoint) {
  const Eigen::Vector3d point(0.3, -0.2, 0.5);
  const Eigen::Vector3d direction = Eigen::Vector3d(1.0, 2.0, -2.0) / 3.0;
  Matrix6d matrix = Matrix6d::Zero();
  addDirection(700.0, direction, point, matrix);
  mirrorUpper(matrix);
  Vector6d motion;
  motion << 0.1, -0.2, 0.3, 0.04, 0.05, -0.06;
  const Eigen::Vector3d shift = motion.head<3>() + Eigen::Vector3d(motion.tail<3>()).cross(point);
  const Eigen::Vector3d force = 700.0 * direction.dot(shift) * direction;
  Vector6d expected;
  expected << force, point.cross(force);
  EXPECT_LT((matrix * motion - expected).norm(), 1e-13 * expected.norm());
  EXPECT_EQ((matrix - matrix.transpose()).norm(), 0.0);
}

TEST(ContactLinearisation, StiffnessAndDampingAreTheDerivativesOfTheNormalForce) {
  NormalForceSettings settings;
  settings.stiffness = 1e5;
  settings.damping = 30.0;
  settings.radius = 0.05;
  const double h = 1e-6;
  for (const NormalForceModel model :
       {NormalForceModel::SpringDashpot, NormalForceModel::Hertz, NormalForceModel::HuntCrossley}) {
    settings.model = model;
    const auto force = [&](double depth, double rate) {
      return normalForce(settings, kElastic, {depth, rate, 1e-5, 1e-9}).force;
    };
    const NormalForce now = normalForce(settings, kElastic, {1e-4, 0.2, 1e-5, 1e-9});
    const double stiffness = (force(1e-4 + 1e-4 * h, 0.2) - force(1e-4 - 1e-4 * h, 0.2)) / (2e-4 * h);
    const double damping = (force(1e-4, 0.2 + h) - force(1e-4, 0.2 - h)) / (2.0 * h);
    // Central differences: rounding 1e-16 F / h.
    EXPECT_NEAR(now.stiffness, stiffness, 1e-8 * stiffness) << toString(model);
    EXPECT_NEAR(now.damping, damping, 1e-7 * now.force) << toString(model);
  }
}

TEST(ContactLinearisation, RegularisedCoulombResistsAsItsDerivatives) {
  FrictionSettings settings;
  settings.model = FrictionModel::RegularisedCoulomb;
  ContactMaterial material = kElastic;
  material.static_friction = material.dynamic_friction;  // the coefficient's own derivative is left out
  const double h = 1e-9;
  for (const double speed : {0.0, 3e-4, 2e-3, 0.1}) {
    const Eigen::Vector3d sliding = speed * Eigen::Vector3d(0.6, 0.8, 0.0);
    const FrictionTangent tangent = frictionTangent(settings, material, 50.0, kSurfaceNormal, sliding, {});
    const auto derivative = [&](const Eigen::Vector3d& direction) {
      const auto force = [&](double step) {
        return regularisedCoulombForce(settings, material, 50.0, sliding + step * direction);
      };
      return -direction.dot(force(h) - force(-h)) / (2.0 * h);
    };
    EXPECT_NEAR(tangent.damping_along, derivative(tangent.along), 1e-6 * 50.0 / 1e-3) << speed;
    EXPECT_NEAR(tangent.damping_across, derivative(tangent.across), 1e-6 * 50.0 / 1e-3) << speed;
    EXPECT_EQ(tangent.stiffness_along + tangent.stiffness_across, 0.0);
  }
}

TEST(ContactLinearisation, BristlesResistWhileTheyStickAndGiveWayAlongWhileTheySlide) {
  FrictionSettings settings;
  settings.model = FrictionModel::Bristle;
  const double load = 20.0;
  const FrictionTangent stuck =
      frictionTangent(settings, kElastic, load, kSurfaceNormal, Eigen::Vector3d::Zero(), {});
  EXPECT_EQ(stuck.stiffness_along, load * settings.bristle_stiffness);
  EXPECT_EQ(stuck.damping_across, load * settings.bristle_damping);
  const Eigen::Vector3d sliding(0.2, 0.0, 0.0);
  RecentSliding recent;
  recent.step = 1e-3;
  recent.displacement = recent.step * sliding;
  recent.bristles.deflection = {kElastic.dynamic_friction / settings.bristle_stiffness, 0.0, 0.0};
  const FrictionTangent slides = frictionTangent(settings, kElastic, load, kSurfaceNormal, sliding, recent);
  EXPECT_NEAR(slides.stiffness_along, 0.0, 1e-9 * stuck.stiffness_along);
  EXPECT_EQ(slides.stiffness_across, stuck.stiffness_across);
}

TEST(ContactLinearisation, TheExpectedDepthIsThatOfAnUndampedImpactOrTheWeight) {
  NormalForceSettings settings;
  settings.model = NormalForceModel::SpringDashpot;
  settings.stiffness = 4e4;
  EXPECT_NEAR(expectedDepth(settings, kElastic, {1.0, 2.0, 0.0}, 0.1), 2.0 / 200.0, 1e-15);
  EXPECT_NEAR(expectedDepth(settings, kElastic, {1.0, 0.0, 8.0}, 0.1), 2e-4, 1e-17);
  settings.model = NormalForceModel::Hertz;
  settings.radius = 0.1;
  const double depth = expectedDepth(settings, kElastic, {1.0, 2.0, 0.0}, 0.1);
  // m v^2 / 2 is the spring's energy at the turn, 2/5 F d.
  EXPECT_NEAR(0.4 * hertzForce(depth, kElastic.contact_modulus, 0.1) * depth, 2.0, 1e-12);
  const double dip = expectedDepth(settings, kElastic, {1.0, 0.0, 9.81}, 0.1);
  EXPECT_NEAR(hertzForce(dip, kElastic.contact_modulus, 0.1), 9.81, 1e-12);
}

}  // namespace
}  // namespace concave_distance::contact_linearisation_test
