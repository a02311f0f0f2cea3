#include "simulation/step_weights.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

namespace concave_distance::detail::step_weights_test {
namespace {

Matrix6d randomMatrix(std::mt19937& engine) {
  std::uniform_real_distribution<double> draw(-1.0, 1.0);
  Matrix6d matrix;
  for (double& entry : matrix.reshaped()) entry = draw(engine);
  return matrix;
}

Matrix6d randomInertia(std::mt19937& engine) {
  const Matrix6d matrix = randomMatrix(engine);
  return matrix * matrix.transpose() + 0.1 * Matrix6d::Identity();
}

TEST(StepWeights, WhatTheStepResolvesIsLeftToTheTrapezoidalRule) {
  std::mt19937 engine(1);
  for (int i = 0; i < 100; ++i) {
    const Matrix6d mass = randomInertia(engine);
    const Matrix6d inverse = mass.inverse();
    // A stiff and a soft direction across each other in the sense of the mass.
    Vector6d stiff = randomMatrix(engine).col(0);
    Vector6d soft = randomMatrix(engine).col(0);
    stiff /= std::sqrt(stiff.dot(inverse * stiff));
    soft -= stiff * stiff.dot(inverse * soft);
    soft /= std::sqrt(soft.dot(inverse * soft));
    StepWeights weights;
    weights.choose(inverse, 50.0 * stiff * stiff.transpose() + 0.5 * soft * soft.transpose());
    ASSERT_FALSE(weights.even());
    EXPECT_LT((weights.ofWrench(soft) - 0.5 * soft).norm(), 1e-10 * soft.norm());
    EXPECT_LT((weights.ofWrench(stiff) - endWeight(50.0) * stiff).norm(), 1e-10 * stiff.norm());
    const Matrix6d kept = weights.ofResistance(soft * soft.transpose(), 1.0);
    EXPECT_LT((kept - 0.5 * soft * soft.transpose()).norm(), 1e-10 * kept.norm());
    const Matrix6d damped = weights.ofResistance(stiff * stiff.transpose(), 2.0);
    EXPECT_LT((damped - std::pow(endWeight(50.0), 2) * stiff * stiff.transpose()).norm(),
              1e-10 * damped.norm());
  }
}

// The kick at the begin is what the equations say: the weighted impulse over the mass is the whole one over
// twice the mass in the step.
TEST(StepWeights, TheMassInTheStepTakesTheWeightedImpulse) {
  std::mt19937 engine(2);
  for (int i = 0; i < 100; ++i) {
    const Matrix6d mass = randomInertia(engine);
    const Matrix6d root = randomMatrix(engine);
    StepWeights weights;
    weights.choose(mass.inverse(), 20.0 * root * root.transpose());
    const Vector6d impulse = randomMatrix(engine).col(0);
    const Vector6d by_mass = mass.inverse() * weights.ofWrench(impulse);
    const Vector6d by_step = weights.massInStep(mass).inverse() * (0.5 * impulse);
    EXPECT_LT((by_mass - by_step).norm(), 1e-9 * by_mass.norm());
  }
}

TEST(StepWeights, AreEvenWhereNothingIsShorterThanTheStep) {
  StepWeights weights;
  weights.choose(Matrix6d::Identity(), 0.16 * Matrix6d::Identity());
  EXPECT_TRUE(weights.even());
  const Vector6d wrench = Vector6d::LinSpaced(1.0, 6.0);
  EXPECT_EQ(weights.ofWrench(wrench), 0.5 * wrench);
}

}  // namespace
}  // namespace concave_distance::detail::step_weights_test
