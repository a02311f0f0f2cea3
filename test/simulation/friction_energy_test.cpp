// Friction takes no energy of what does not slide: elastic balls that bounce and roll, at three scales.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "simulation/elastic_ball.h"

namespace concave_distance::friction_energy_test {
namespace {

using test::ElasticBall;

constexpr double kScales[] = {1e-3, 1.0, 100.0};  // metres
constexpr FrictionModel kModels[] = {FrictionModel::None, FrictionModel::Bristle,
                                     FrictionModel::RegularisedCoulomb};

TEST(FrictionEnergy, TenElasticBouncesKeepTheirHeightWithFrictionOn) {
  for (const double radius : kScales) {
    for (const FrictionModel friction : kModels) {
      SCOPED_TRACE(std::to_string(radius) + " " + std::string(toString(friction)));
      const double fall = 3.0 * radius;
      Simulation simulation = ElasticBall{radius, friction}.overPlane(fall).simulation();
      std::vector<double> heights;
      double before = 0.0;
      while (heights.size() < 10 && simulation.time() < 30.0 * std::sqrt(8.0 * fall / 9.81)) {
        simulation.step();
        const SimulatedBody& ball = simulation.bodies()[1];
        const double rise = 0.5 * ball.velocity.z() * ball.velocity.z() / 9.81;  // steps end beside the top
        if (before > 0.0 && ball.velocity.z() <= 0.0) heights.push_back(ball.centre.z() + rise - radius);
        before = ball.velocity.z();
      }
      ASSERT_EQ(heights.size(), 10U);
      EXPECT_NEAR(heights.back(), fall, 0.01 * fall);
      EXPECT_LT(std::abs(simulation.energy().balanceError()), 0.01 * simulation.energy().largest_kinetic);
    }
  }
}

TEST(FrictionEnergy, ABallRollsOnWithFrictionOn) {
  for (const double radius : kScales) {
    for (const FrictionModel friction : {FrictionModel::Bristle, FrictionModel::RegularisedCoulomb}) {
      SCOPED_TRACE(std::to_string(radius) + " " + std::string(toString(friction)));
      const double speed = 0.5 * std::sqrt(radius);
      const double duration = std::min(10.0, 10.0 * std::sqrt(10.0 * radius));  // of small ones the steps are
      Simulation simulation = ElasticBall{radius, friction}.rollingOnPlane(speed, duration).simulation();
      const double energy = simulation.energy().kinetic;
      simulation.advanceTo(duration);
      EXPECT_NEAR(simulation.bodies()[1].velocity.x(), speed, 0.01 * speed);
      EXPECT_NEAR(simulation.energy().kinetic, energy, 0.01 * energy);
    }
  }
}

// Friction holds it back and pushes it on in turns: it must not creep where the patch moves on.
TEST(FrictionEnergy, ABallRollsInABowlWithFrictionOn) {
  const double radius = 0.1;
  Simulation simulation = ElasticBall{radius, FrictionModel::Bristle}.inBowl(0.3).simulation();
  double first = 0.0;
  double last = 0.0;
  while (simulation.time() < 5.0) {
    simulation.step(5.0);
    const double kinetic = simulation.energy().kinetic;
    if (simulation.time() < 1.0) first = std::max(first, kinetic);
    if (simulation.time() > 4.0) last = std::max(last, kinetic);
  }
  EXPECT_NEAR(last, first, 0.005 * first);
  EXPECT_LT(std::abs(simulation.energy().balanceError()), 1e-3 * first);
}

}  // namespace
}  // namespace concave_distance::friction_energy_test
