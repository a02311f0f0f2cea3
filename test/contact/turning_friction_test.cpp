#include "contact/turning_friction.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace concave_distance::turning_friction_test {
namespace {

constexpr double kArm = 0.05;
constexpr double kRolling = 2e-3;
constexpr double kSpinning = 5e-4;
constexpr double kLoad = 30.0;
constexpr FrictionModel kModels[] = {FrictionModel::RegularisedCoulomb, FrictionModel::Bristle};

/// Slides without friction, so that what is measured is turning's.
ContactMaterial material() {
  ContactMaterial material{};
  material.rolling_friction = kRolling;
  material.spinning_friction = kSpinning;
  return material;
}

FrictionSettings settingsOf(FrictionModel model) {
  FrictionSettings settings;
  settings.model = model;
  return settings;
}

const Eigen::Vector3d kNormal = Eigen::Vector3d(2.0, -1.0, 2.0) / 3.0;
const TurningContact kContact{kNormal, kLoad, kArm};

/// After turning steadily for `steps` steps.
Eigen::Vector3d torqueAfter(FrictionModel model, const Eigen::Vector3d& rate, double step, int steps) {
  TurningBristles bristles;
  Eigen::Vector3d torque;
  for (int k = 0; k < steps; ++k) {
    ContactLinearisation linearisation;
    torque = resistTurning(settingsOf(model), material(), kContact, {rate, step * rate, step}, bristles,
                           linearisation);
  }
  return torque;
}

TEST(TurningFriction, OpposesRollingByItsArmTimesTheForce) {
  const Eigen::Vector3d across = kNormal.unitOrthogonal();
  for (const FrictionModel model : kModels) {
    const Eigen::Vector3d torque = torqueAfter(model, 20.0 * across, 1e-4, 2000);
    // The regularised one is short of it by (v_r / v)^2 / 2 with v = 1 m/s.
    EXPECT_LT((torque + kRolling * kLoad * across).norm(), 1e-6 * kRolling * kLoad) << toString(model);
  }
}

TEST(TurningFriction, OpposesSpinningByItsArmTimesTheForce) {
  for (const FrictionModel model : kModels) {
    for (const double rate : {20.0, -20.0}) {
      const Eigen::Vector3d torque = torqueAfter(model, rate * kNormal, 1e-4, 2000);
      const double expected = -std::copysign(kSpinning * kLoad, rate);
      EXPECT_LT((torque - expected * kNormal).norm(), 1e-6 * kSpinning * kLoad) << toString(model);
    }
  }
}

TEST(TurningFriction, BothAtOnceDoNotDisturbEachOther) {
  const Eigen::Vector3d across = kNormal.unitOrthogonal();
  for (const FrictionModel model : kModels) {
    const Eigen::Vector3d torque = torqueAfter(model, 20.0 * across + 15.0 * kNormal, 1e-4, 2000);
    const Eigen::Vector3d expected = -kLoad * (kRolling * across + kSpinning * kNormal);
    EXPECT_LT((torque - expected).norm(), 1e-5 * kRolling * kLoad) << toString(model);
  }
}

TEST(TurningFriction, BristlesHoldAsTorsionalSpringsUntilTheyBreakAway) {
  const FrictionSettings settings = settingsOf(FrictionModel::Bristle);
  const double stiffness = kLoad * settings.bristle_stiffness * kArm * kArm;
  TurningBristles bristles;
  ContactLinearisation linearisation;
  const Eigen::Vector3d turn = 0.5 * kSpinning * kLoad / stiffness * kNormal;
  resistTurning(settings, material(), kContact, {Eigen::Vector3d::Zero(), turn, 1e-3}, bristles,
                linearisation);
  // At rest since: the torque stays.
  for (int k = 0; k < 1000; ++k) {
    linearisation = {};
    const Eigen::Vector3d torque =
        resistTurning(settings, material(), kContact,
                      {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 1e-3}, bristles, linearisation);
    ASSERT_LT((torque + stiffness * turn).norm(), 1e-12 * kSpinning * kLoad);
  }
}

TEST(TurningFriction, TheLinearisationIsTheDerivativeOfTheTorque) {
  const double h = 1e-7;
  for (const FrictionModel model : kModels) {
    const FrictionSettings settings = settingsOf(model);
    ContactLinearisation linearisation;
    TurningBristles still;
    resistTurning(settings, material(), kContact, {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 1e-3},
                  still, linearisation);
    mirrorUpper(linearisation.stiffness);
    mirrorUpper(linearisation.damping);
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d unit = Eigen::Vector3d::Unit(axis);
      const auto torque = [&](const Eigen::Vector3d& rate, const Eigen::Vector3d& turn) {
        TurningBristles bristles;
        ContactLinearisation unused;
        return resistTurning(settings, material(), kContact, {rate, turn, 1e-3}, bristles, unused);
      };
      const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
      const Eigen::Vector3d by_rate = -(torque(h * unit, zero) - torque(-h * unit, zero)) / (2.0 * h);
      const Eigen::Vector3d by_turn = -(torque(zero, h * unit) - torque(zero, -h * unit)) / (2.0 * h);
      const Matrix6d& damping = linearisation.damping;
      const Matrix6d& stiffness = linearisation.stiffness;
      EXPECT_LT((by_rate - damping.block<3, 1>(3, 3 + axis)).norm(), 1e-6 * damping.norm() + 1e-12);
      EXPECT_LT((by_turn - stiffness.block<3, 1>(3, 3 + axis)).norm(), 1e-6 * stiffness.norm() + 1e-12);
    }
    EXPECT_EQ(linearisation.damping.topRows<3>().norm() + linearisation.stiffness.topRows<3>().norm(), 0.0);
  }
}

TEST(TurningFriction, OverACycleNothingIsGained) {
  for (const FrictionModel model : kModels) {
    TurningBristles bristles;
    const double step = 1e-5;
    double work = 0.0;
    for (int k = 0; k < 40000; ++k) {
      const Eigen::Vector3d rate(2.0 * std::sin(k * 1e-3), std::cos(k * 7e-4), 0.5 * std::sin(k * 3e-4));
      ContactLinearisation linearisation;
      work += step * rate.dot(resistTurning(settingsOf(model), material(), kContact,
                                            {rate, step * rate, step}, bristles, linearisation));
    }
    EXPECT_LT(work, 0.0) << toString(model);
  }
}

TEST(TurningFriction, WithoutCoefficientsThereIsNone) {
  EXPECT_FALSE(resistsTurning(ContactMaterial{}));
  EXPECT_TRUE(resistsTurning(material()));
}

}  // namespace
}  // namespace concave_distance::turning_friction_test
