#include "concave_distance/contact/normal_force.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/constants.h"
#include "concave_distance/base/error.h"
#include "contact/contact_point.h"
#include "support/hunt_crossley_rebound.h"

namespace concave_distance::normal_force_test {
namespace {

/// A sphere of radius R that dips into a plane by d: the circle that the plane cuts from it.
ContactGeometry sphereInPlane(double radius, double depth, double depth_rate = 0.0) {
  return {depth, depth_rate, kPi * (2.0 * radius * depth - depth * depth)};
}

TEST(NormalForce, HertzOfAKnownCase) {
  // Two steel balls of 10 mm radius pressed 1 um into each other; E* = 115.385 GPa, R = 5 mm.
  EXPECT_NEAR(hertzForce(1e-6, 1.15384615e11, 5e-3), 10.8786, 1e-4);
}

TEST(NormalForce, TheWorkOfHertzIsItsIntegral) {
  const double modulus = 3e8;
  const double radius = 0.02;
  const double depth = 1e-3;
  const int steps = 20000;
  double work = 0.0;
  for (int k = 0; k < steps; ++k)
    work += hertzForce((k + 0.5) * depth / steps, modulus, radius) * depth / steps;
  const double closed_form = 8.0 / 15.0 * modulus * std::sqrt(radius) * std::pow(depth, 2.5);
  EXPECT_NEAR(work, closed_form, 1e-6 * closed_form);
}

TEST(NormalForce, QuasiStaticWithHertzsCoefficientIsHertzOnTheGeometricOverlap) {
  for (const double depth : {1e-9, 1e-6, 1e-4}) {
    const ContactGeometry contact = sphereInPlane(0.1, depth);
    const double hertz = hertzForce(depth, 1e9, 0.1);
    // The circle is smaller than 2 R d by d^2: half of that share in its radius.
    EXPECT_NEAR(quasiStaticForce(contact, 1e9, kHertzLoadingCoefficient, 0.0), hertz, hertz * depth / 0.1);
  }
}

TEST(NormalForce, RadiusOfASphereIsFoundFromItsOverlap) {
  for (const double depth : {1e-8, 1e-5, 1e-3}) {
    EXPECT_NEAR(radiusFromOverlap(sphereInPlane(0.25, depth)), 0.25, 0.51 * depth);
  }
  EXPECT_EQ(radiusFromOverlap({}), 0.0);
}

TEST(NormalForce, NoModelPullsAndNoneActsWithoutDepth) {
  ContactMaterial material{1e9, 5.0, 0.0, 0.0, 0.0};
  NormalForceSettings settings;
  settings.damping = 1e6;
  for (const NormalForceModel model : {NormalForceModel::QuasiStatic, NormalForceModel::SpringDashpot,
                                       NormalForceModel::Hertz, NormalForceModel::HuntCrossley}) {
    settings.model = model;
    EXPECT_GT(normalForce(settings, material, sphereInPlane(0.1, 1e-4)).force, 0.0) << toString(model);
    EXPECT_GE(normalForce(settings, material, sphereInPlane(0.1, 1e-4, -100.0)).force, 0.0)
        << toString(model);
    EXPECT_EQ(normalForce(settings, material, {0.0, 1.0, 0.0}).force, 0.0) << toString(model);
  }
}

TEST(NormalForce, ParametersOutOfRangeAreNamed) {
  NormalForceSettings settings;
  settings.stiffness = 0.0;
  try {
    settings.validate("pairs.normal_force");
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "pairs.normal_force: stiffness is 0 (allowed: greater than 0 (N/m))");
  }
}

/// Rebound speed of a mass m that meets Hunt and Crossley's spring at speed v, by Runge and Kutta.
double reboundSpeed(double mass, double speed, double modulus, double radius, double dissipation) {
  // Hertz's contact time is about 2.87 (m^2 / (R E*^2 v))^(1/5) (Johnson 1985, eq. (11.24) for E* there).
  const double contact_time = 2.87 * std::pow(mass * mass / (radius * modulus * modulus * speed), 0.2);
  const double h = contact_time / 4000.0;
  double depth = 0.0;
  double rate = speed;
  const auto acceleration = [&](double d, double v) {
    return -huntCrossleyForce(d, v, modulus, radius, dissipation) / mass;
  };
  do {
    const double k1v = acceleration(depth, rate);
    const double k2v = acceleration(depth + 0.5 * h * rate, rate + 0.5 * h * k1v);
    const double k3v = acceleration(depth + 0.5 * h * (rate + 0.5 * h * k1v), rate + 0.5 * h * k2v);
    const double k4v = acceleration(depth + h * (rate + 0.5 * h * k2v), rate + h * k3v);
    depth += h * (rate + h / 6.0 * (k1v + k2v + k3v));
    rate += h / 6.0 * (k1v + 2.0 * k2v + 2.0 * k3v + k4v);
  } while (depth > 0.0);
  return -rate;
}

TEST(NormalForce, RestitutionOfHuntCrossleyFollowsItsClosedForm) {
  for (const double dissipation : {0.05, 0.3, 1.0}) {
    for (const double speed : {0.05, 0.5, 2.0}) {
      const double expected = test::huntCrossleyRebound(speed, dissipation);
      EXPECT_NEAR(reboundSpeed(0.2, speed, 1e8, 0.05, dissipation), expected, 1e-4 * speed)
          << "c " << dissipation << ", v " << speed;
    }
  }
}

// A plate of sides a and b that dips in with its mean depth d, tilted about its middle: k_f a b d whatever
// the tilt, at the centroid of the wedge; the moment about the middle is that of the springs' potential.
TEST(NormalForce, ElasticFoundationIsTheSumOfItsSprings) {
  const double stiffness = 1e8;
  const double a = 0.3;
  const double b = 0.2;
  const double depth = 2e-3;
  const double slope = 5e-3;
  double force = 0.0;
  double moment = 0.0;
  const int cells = 2000;
  for (int i = 0; i < cells; ++i) {
    const double x = (i + 0.5) / cells * a - 0.5 * a;
    const double pressure = stiffness * (depth + slope * x);
    force += pressure * a * b / cells;
    moment += x * pressure * a * b / cells;
  }
  const double volume = a * b * depth;
  const double centroid = slope * a * a * a * b / 12.0 / volume;
  EXPECT_NEAR(elasticFoundationForce(volume, 0.0, stiffness, 0.5), force, 1e-9 * force);
  EXPECT_NEAR(elasticFoundationForce(volume, 0.0, stiffness, 0.5) * centroid, moment, 1e-6 * moment);
  EXPECT_DOUBLE_EQ(elasticFoundationForce(volume, 0.2, stiffness, 0.5), 1.15 * stiffness * volume);
  EXPECT_EQ(elasticFoundationForce(volume, -10.0, stiffness, 0.5), 0.0);
  EXPECT_EQ(elasticFoundationForce(0.0, 1.0, stiffness, 0.5), 0.0);
}

TEST(NormalForce, RestitutionAtSmallSpeedsIsOneMinusDissipationTimesSpeed) {
  EXPECT_NEAR(test::huntCrossleyRebound(0.01, 0.2) / 0.01, 1.0 - 0.2 * 0.01, 1e-5);
}

TEST(ContactPoint, MotionAtAContactSplitsIntoDepthRateAndSliding) {
  ContactPoint contact;
  contact.point_in_a = {1.0, 0.0, 0.0};
  contact.normal_in_a = Eigen::Vector3d::UnitZ();
  RelativeTwist twist;
  twist.linear = {0.5, 0.0, -2.0};
  twist.angular = {0.0, 3.0, 1.0};  // at (1, 0, 0): adds (0, 1, -3)
  setRelativeMotion(twist, contact);
  EXPECT_DOUBLE_EQ(contact.geometry.depth_rate, 5.0);
  EXPECT_LT((contact.sliding_in_a - Eigen::Vector3d(0.5, 1.0, 0.0)).norm(), 1e-15);
}

TEST(ContactPoint, TheMomentOfAForceIsTakenAboutTheGivenPoint) {
  const Wrench wrench = wrenchAbout({0.0, 2.0, 0.0}, {3.0, 0.0, 0.0}, {1.0, 0.0, 0.0});
  EXPECT_LT((wrench.torque - Eigen::Vector3d(0.0, 0.0, 4.0)).norm(), 1e-15);
}

}  // namespace
}  // namespace concave_distance::normal_force_test
