// Working memory stays below the limit, and the answer says what was given up for it.
#include <gtest/gtest.h>

#include <cmath>

#include "concave_distance/search/prepare_search.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "mesh/trees/normal_cone_tree.h"
#include "search/grid/body_grid.h"
#include "support/body_pairs.h"
#include "support/count_allocations.h"
#include "support/enumeration.h"
#include "support/mesh_variants.h"

namespace concave_distance::memory_limit_test {
namespace {

TEST(MemoryLimit, HoldsForFloodsOfALargeProminenceAndTheBracketHoldsToo) {
  const auto comb = test::makeBody(test::halvedEdges(test::makeComb(5)), 0.1);
  Eigen::Isometry3d pose(Eigen::AngleAxisd(3.14159265358979323846, Eigen::Vector3d::UnitZ()));
  pose.translation() = Eigen::Vector3d(1.23, 0.65, 0.02);
  const double exact = std::sqrt(test::enumerateTrianglePairs(*comb, *comb, pose).squared_distance);
  TrackerParameters parameters;
  parameters.accuracy = AccuracyLevel::Certified;
  parameters.prominence_limit = 50.0;
  // What belongs to the bodies is built before.
  comb->adjacency();
  comb->pieces();
  prepareSearch({comb.get()});
  gridOf(*comb).geodesicExtent();
  comb->normalCones(NormalSides::Outside);
  for (const std::size_t limit : {std::size_t{2} << 20U, std::size_t{3} << 20U}) {
    parameters.memory_limit = limit;
    PairTracker tracker("pair", comb, comb, parameters);
    PairSolution solution;
    const std::size_t before = allocated_bytes.load() - tracker.memoryBytes();
    most_allocated_bytes = 0;
    for (int k = 0; k < 3; ++k) {
      pose.translation().y() += 1e-3;
      tracker.update(pose, 0.01 * k, solution);
      EXPECT_EQ(solution.status, SolveStatus::MemoryExhausted) << toString(solution.status);
      EXPECT_FALSE(solution.niches_complete);
      const double truth = std::sqrt(test::enumerateTrianglePairs(*comb, *comb, pose).squared_distance);
      EXPECT_LE(solution.lower_bound, truth);
      EXPECT_NEAR(solution.distance, truth, 1e-12) << "the proof needs little memory";
    }
    // Buffers of fixed size, the solution and the allocator's rounding are not counted.
    EXPECT_LT(most_allocated_bytes.load() - before, limit + limit / 8 + (std::size_t{1} << 20U));
  }
  parameters.prominence_limit = 0.0;
  parameters.memory_limit = TrackerParameters().memory_limit;
  EXPECT_TRUE(solveOnce("pair", comb, comb, parameters, pose).niches_complete);
  EXPECT_GT(exact, 0.0);
}

}  // namespace
}  // namespace concave_distance::memory_limit_test
