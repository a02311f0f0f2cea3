#include "kinematics/motion_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "kinematics/waypoints.h"

namespace concave_distance::motion_curve_test {
namespace {

using detail::MotionCurve;

MotionCurve::Coefficients randomCoefficients(std::size_t degree, std::mt19937& engine) {
  std::uniform_real_distribution<double> number(-2.0, 2.0);
  MotionCurve::Coefficients coefficients{};
  for (std::size_t k = 0; k <= degree; ++k) coefficients[k] = number(engine);
  return coefficients;
}

TEST(MotionCurve, BoundsRatesAndWayOfAnyPartOfASegment) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int trial = 0; trial < 300; ++trial) {
    const std::size_t degree = trial % 3 == 0 ? 1 : trial % 3 == 1 ? 3 : 5;
    const MotionCurve curve({randomCoefficients(degree, engine)}, degree);
    const auto [from, to] = std::minmax({unit(engine), unit(engine)});
    const MotionCurve::Bounds bounds = curve.bounds(0, from, to);
    double rate = 0.0;
    double acceleration = 0.0;
    double way = 0.0;
    constexpr int kPlaces = 2000;
    const double step = (to - from) / kPlaces;
    for (int i = 0; i < kPlaces; ++i) {
      const double at = from + i * step;
      rate = std::max(rate, std::abs(curve.rate({0, at})));
      acceleration =
          std::max(acceleration, std::abs(curve.rate({0, at + step}) - curve.rate({0, at})) / step);
      way += std::abs(curve.value({0, at + step}) - curve.value({0, at}));
    }
    ASSERT_GE(bounds.rate * (1.0 + 1e-12), rate) << trial;
    ASSERT_GE(bounds.acceleration + 1e-9, acceleration) << trial;
    // The sum of 2000 differences of numbers up to 12 is off by their rounding.
    ASSERT_GE(bounds.variation + 1e-11, way) << trial;
    if (degree == 1) {
      ASSERT_NEAR(bounds.variation, way, 1e-11);
    }
  }
}

TEST(MotionCurve, BoundsShrinkToTheRateOfASmallPart) {
  std::mt19937 engine(2);
  const MotionCurve curve({randomCoefficients(5, engine)}, 5);
  const MotionCurve::Bounds bounds = curve.bounds(0, 0.4, 0.4 + 1e-6);
  EXPECT_NEAR(bounds.rate, std::abs(curve.rate({0, 0.4})), 1e-4);
  EXPECT_NEAR(bounds.variation, 1e-6 * bounds.rate, 1e-9);
}

TEST(MotionCurve, AddsUpTheWayOverSegments) {
  const MotionCurve curve = MotionCurve::straight({0.0, 2.0, 1.0, 1.0, 5.0});
  EXPECT_EQ(curve.segmentCount(), 4U);
  EXPECT_NEAR(curve.variation(0.0, 4.0), 7.0, 1e-12);
  EXPECT_NEAR(curve.variation(0.5, 1.25), 1.25, 1e-12);
  EXPECT_NEAR(curve.variation(3.5, 4.0), 2.0, 1e-12);
  EXPECT_EQ(curve.variation(2.0, 2.0), 0.0);
  EXPECT_NEAR(curve.scaled(-3.0, 1.0).value({0, 0.5}), -2.0, 1e-15);
  EXPECT_NEAR(curve.scaled(-3.0, 1.0).variation(0.0, 2.0), 9.0, 1e-12);
}

TEST(MotionCurve, IsConstantAtOneWaypoint) {
  const MotionCurve curve = MotionCurve::straight({3.0});
  EXPECT_EQ(curve.value(detail::momentAt(0.0, 1)), 3.0);
  EXPECT_EQ(curve.variation(0.0, 0.0), 0.0);
}

// The rates and their rates at waypoints are those that the motion gives, by seconds.
TEST(MotionCurve, RunsThroughWaypointsWithTheirVelocitiesAndAccelerations) {
  JointMotion motion;
  motion.joints = {"j"};
  motion.times = {1.0, 1.5, 3.5};
  motion.positions = Eigen::Vector3d(0.2, -0.4, 1.0);
  motion.velocities = Eigen::Vector3d(0.0, 0.7, -0.3);
  for (const bool is_quintic : {false, true}) {
    if (is_quintic) motion.accelerations = Eigen::Vector3d(0.5, -0.25, 2.0);
    const MotionCurve curve = detail::curveOf(motion, motion.times, 0);
    for (std::size_t segment = 0; segment < 2; ++segment) {
      const double seconds = motion.times[segment + 1] - motion.times[segment];
      for (const std::size_t end : {std::size_t{0}, std::size_t{1}}) {
        const auto row = static_cast<Eigen::Index>(segment + end);
        const auto share = static_cast<double>(end);
        EXPECT_NEAR(curve.value({segment, share}), motion.positions(row, 0), 1e-14);
        EXPECT_NEAR(curve.rate({segment, share}) / seconds, motion.velocities(row, 0), 1e-14);
        if (!is_quintic) continue;
        const double inside = end == 0 ? 1e-6 : 1.0 - 1e-6;
        const double difference = curve.rate({segment, inside}) - curve.rate({segment, share});
        EXPECT_NEAR(difference / (inside - share) / (seconds * seconds), motion.accelerations(row, 0), 1e-3);
      }
    }
  }
}

}  // namespace
}  // namespace concave_distance::motion_curve_test
