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
using test::SceneBuilder;

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

// Friction takes what slides, and the integration nothing: the oracle is a hundredth of the step.
TEST(FrictionEnergy, FreeBallsThatMeetOffTheirCentresLoseWhatShortStepsLose) {
  for (const double radius : {1e-3, 1.0}) {
    for (const FrictionModel friction : {FrictionModel::Bristle, FrictionModel::RegularisedCoulomb}) {
      for (const double share : {0.2, 0.8}) {
        SCOPED_TRACE(std::to_string(radius) + " " + std::string(toString(friction)) + " " +
                     std::to_string(share));
        const double speed = 0.1 * std::sqrt(6.0 * 9.81 * radius);
        SceneBuilder builder =
            ElasticBall{radius, friction}.meeting(3.0 * radius, 2.0 * share * radius, speed);
        const auto kept = [&] {
          Simulation simulation = builder.simulation();
          const double energy = simulation.energy().kinetic;
          simulation.advanceTo(4.0 * radius / speed);
          EXPECT_GT(simulation.pairs()[0].lower_bound, 0.0);
          EXPECT_LT(std::abs(simulation.energy().balanceError()), 1e-3 * energy);
          return simulation.energy().kinetic / energy;
        };
        const double with_defaults = kept();
        builder.settings.step_fraction = 0.02;
        builder.settings.work_tolerance = 1e-5;
        builder.settings.largest_step = 1e-3 * radius / speed;
        EXPECT_NEAR(with_defaults, kept(), 1e-3);
      }
    }
  }
}

TEST(FrictionEnergy, ABallRollsOnOnAFreePlate) {
  for (const double radius : kScales) {
    SCOPED_TRACE(radius);
    const double speed = 0.5 * std::sqrt(radius);
    const double duration = std::min(10.0, 10.0 * std::sqrt(10.0 * radius));
    Simulation simulation =
        ElasticBall{radius, FrictionModel::Bristle}.rollingOnFreePlate(speed, duration).simulation();
    simulation.advanceTo(duration);
    EXPECT_NEAR(simulation.bodies()[2].velocity.x(), speed, 0.01 * speed);
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
