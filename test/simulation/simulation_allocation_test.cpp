#include <gtest/gtest.h>

#include "simulation/box_stack.h"
#include "support/count_allocations.h"

namespace concave_distance::simulation_allocation_test {
namespace {

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
}  // namespace concave_distance::simulation_allocation_test
