#include <gtest/gtest.h>

#include "concave_distance/interference/interference.h"
#include "support/body_pairs.h"
#include "support/count_allocations.h"

namespace concave_distance::interference_allocation_test {
namespace {

TEST(Interference, AllocatesNothingOnceItsWorkspaceHasGrown) {
  const auto a = test::makeBody(makeSphere(0.5, 1e-3));
  const auto b = test::makeBody(test::makeComb(4));
  const auto c = test::makeBody(makeBox({1, 1, 1}));
  InterferenceWorkspace workspace;
  Interference result;
  std::size_t before = 0;
  for (int round = 0; round < 3; ++round) {
    if (round == 2) before = allocations;
    findInterference(*a, *b, test::translation({0.1, 0.2, 0.1}), workspace, result);
    EXPECT_FALSE(result.regions.empty());
    findInterference(*c, *c, test::translation({0.25, 0.0, 0.0}), workspace, result);  // flush: two passes
    EXPECT_FALSE(result.regions.empty());
    findInterference(*c, *a, test::translation({0.0, 0.0, 0.0}), workspace,
                     result);  // swallowed but for touching
    EXPECT_FALSE(result.regions.empty());
  }
  EXPECT_EQ(allocations, before);
}

}  // namespace
}  // namespace concave_distance::interference_allocation_test
