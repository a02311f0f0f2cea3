#include <gtest/gtest.h>

#include <vector>

#include "simulation/box_stack.h"
#include "support/count_allocations.h"

namespace concave_distance {
namespace {

TEST(SimulationAllocation, ASteadyStepAllocatesNothing) {
  Simulation simulation = test::stackOf({1.0, 1.0, 1.0}).simulation();
  simulation.advanceTo(10.0);  // buffers grow with the largest region so far
  const std::size_t before = allocations;
  for (int i = 0; i < 200; ++i) simulation.step();
  EXPECT_EQ(allocations - before, 0U);
}

}  // namespace
}  // namespace concave_distance
