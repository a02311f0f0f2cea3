#include <gtest/gtest.h>

#include <vector>

#include "simulation/box_stack.h"
#include "support/count_allocations.h"

namespace concave_distance::resting_contact_test {
namespace {

using test::stackOf;

constexpr double kGravity = 9.81;
/// Holds a stack that has come to rest to its closed form: each contact as deep as what is on it presses it.
void expectAtRest(const Simulation& simulation, const std::vector<double>& masses) {
  double load = 0.0;
  for (std::size_t i = masses.size(); i-- > 0;) {
    load += masses[i] * kGravity;
    const SimulatedBody& body = simulation.bodies()[i + 1];
    const auto& regions = simulation.pairs()[i].contacts.regions;
    ASSERT_EQ(regions.size(), 1U) << i;
    EXPECT_NEAR(regions[0].overlap.depth, load / (test::kStackFoundation * test::kStackArea),
                1e-3 * load / (test::kStackFoundation * test::kStackArea));
    EXPECT_NEAR(regions[0].normal_force, load, 1e-3 * load) << i;
    EXPECT_LT(body.centre.head<2>().norm(), 1e-9) << i;
    EXPECT_LT(body.velocity.norm(), 1e-6) << i;
    EXPECT_LT(body.angular_velocity.norm(), 1e-6) << i;
  }
  EXPECT_LT(simulation.energy().mechanical(), simulation.energy().initial);
  EXPECT_TRUE(simulation.energyIsBalanced());
}

TEST(RestingContact, ABoxStandsStill) {
  const std::vector<double> masses = {1.0};
  Simulation simulation = stackOf(masses).simulation();
  simulation.advanceTo(5.0);
  const Eigen::Isometry3d before = simulation.bodies()[1].world_from_body;
  const double energy = simulation.energy().mechanical();
  simulation.advanceTo(30.0);
  expectAtRest(simulation, masses);
  EXPECT_LT((simulation.bodies()[1].world_from_body.matrix() - before.matrix()).norm(), 1e-11);
  EXPECT_NEAR(simulation.energy().mechanical(), energy, 1e-10);
}

TEST(RestingContact, StacksOfThreeAndFiveStandStill) {
  for (const std::size_t count : {3, 5}) {
    const std::vector<double> masses(count, 1.0);
    Simulation simulation = stackOf(masses).simulation();
    simulation.advanceTo(10.0);
    expectAtRest(simulation, masses);
    // A thousand steps of 10 ms, and what the first moments take.
    EXPECT_LT(simulation.counters().steps, 2000U) << count;
  }
}

TEST(RestingContact, AHundredKilogramsStandOnAHundredGrams) {
  const std::vector<double> masses = {0.1, 100.0};
  Simulation simulation = stackOf(masses).simulation();
  simulation.advanceTo(5.0);
  expectAtRest(simulation, masses);
  EXPECT_LT(simulation.counters().steps, 1500U);
}

TEST(SimulationAllocation, ASteadyStepAllocatesNothing) {
  test::SceneBuilder stack = test::stackOf({1.0, 1.0, 1.0});
  Material& floor = stack.scene.bodies.edit(0).material;
  floor.rolling_friction = floor.spinning_friction = 0.01;
  Simulation simulation = stack.simulation();
  simulation.advanceTo(10.0);  // buffers grow with the largest region so far
  const std::size_t before = allocations;
  for (int i = 0; i < 200; ++i) simulation.step();
  EXPECT_EQ(allocations - before, 0U);
}

}  // namespace
}  // namespace concave_distance::resting_contact_test
