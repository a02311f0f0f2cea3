// A pair and its bodies keep little in memory, and only what is asked for is made.
#include <gtest/gtest.h>

#include <tbb/parallel_for.h>
#include <cmath>
#include <memory>
#include <vector>

#include "concave_distance/mesh/surface/primitives.h"
#include "concave_distance/search/prepare_search.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "mesh/metric_memory.h"
#include "mesh/trees/normal_cone_tree.h"
#include "search/grid/body_grid.h"
#include "search/grid/mesh_metric.h"
#include "search/grid/node_graph.h"
#include "support/body_pairs.h"
#include "support/concave_shapes.h"
#include "support/count_allocations.h"
#include "support/enumeration.h"
#include "support/mesh_variants.h"

namespace concave_distance::tracker_memory_test {
namespace {

constexpr int kCycles = 20;

std::shared_ptr<const BodyMesh> bodyOf(SurfaceMesh surface, const BodyMeshOptions& options = {}) {
  return std::make_shared<const BodyMesh>("body", std::move(surface), options);
}

Eigen::Isometry3d poseAt(int cycle) {
  Eigen::Isometry3d pose(Eigen::AngleAxisd(0.01 * cycle, Eigen::Vector3d::UnitX()));
  pose.translation() = Eigen::Vector3d(0.2, 0.1, 2.5 + 0.01 * cycle);
  return pose;
}

std::size_t trackedBytes(const std::shared_ptr<const BodyMesh>& a, const std::shared_ptr<const BodyMesh>& b,
                         const TrackerParameters& parameters) {
  std::size_t bytes = 0;
  for (int round = 0; round < 2; ++round) {  // in the first one the bodies make their own parts
    const std::size_t before = allocated_bytes;
    PairTracker tracker("pair", a, b, parameters);
    PairSolution solution;
    for (int cycle = 0; cycle < kCycles; ++cycle) {
      tracker.update(poseAt(cycle), 0.01 * cycle, solution);
    }
    bytes = allocated_bytes - before;
  }
  return bytes;
}

TEST(TrackerMemory, AProofAloneMakesNothingOfTheSearch) {
  const auto a = bodyOf(makeBox(Eigen::Vector3d(1.0, 1.0, 1.0)));
  const auto b = bodyOf(test::makeComb(3));
  TrackerParameters parameters;
  parameters.niches_wanted = false;
  EXPECT_LT(trackedBytes(a, b, parameters), 80'000U);
  EXPECT_EQ(a->attachment(), nullptr);
  EXPECT_EQ(b->attachment(), nullptr);
}

TEST(TrackerMemory, APairWithNichesTakesAFewHundredKilobytes) {
  const auto a = bodyOf(makeBox(Eigen::Vector3d(1.0, 1.0, 1.0)));
  const auto b = bodyOf(test::makeComb(3));
  EXPECT_LT(trackedBytes(a, b, TrackerParameters()), 600'000U);
  TrackerParameters nodes;
  nodes.accuracy = AccuracyLevel::Nodes;  // a cold run meets more than a thousand places
  EXPECT_LT(trackedBytes(a, b, nodes), 900'000U);
  EXPECT_NE(gridOf(*b).metricIfMade(), nullptr);
}

TEST(BodyMesh, ManyThreadsThatNeedItsSearchAtOnceGetTheSame) {
  const auto body = bodyOf(test::makeComb(4));
  std::vector<const MeshMetric*> seen(64);
  // Each task waits for the body inside a parallel loop, as pairs do that share it.
  tbb::parallel_for(std::size_t{0}, seen.size(), [&](std::size_t i) { seen[i] = &gridOf(*body).metric(); });
  for (const MeshMetric* metric : seen) EXPECT_EQ(metric, seen.front());
}

TEST(BodyMesh, PreparingBodiesGivesMatricesInTheirOrder) {
  BodyMeshOptions options;
  const std::size_t nodes = gridOf(*bodyOf(makeBox(Eigen::Vector3d(1.0, 1.0, 1.0)))).graph().nodeCount();
  options.metric_memory = std::make_shared<MetricMemory>(2 * MeshMetric::matrixBytes(nodes));
  std::vector<std::shared_ptr<const BodyMesh>> bodies;
  std::vector<const BodyMesh*> order;
  for (int i = 0; i < 8; ++i) {
    bodies.push_back(bodyOf(makeBox(Eigen::Vector3d(1.0, 1.0, 1.0)), options));
    order.push_back(bodies.back().get());
  }
  prepareSearch(order);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    EXPECT_EQ(gridOf(*bodies[i]).metric().isThinned(), i >= 2) << i;
  }
  prepareSearch(order);  // nothing left to do
  order.clear();
  bodies.clear();
  EXPECT_EQ(options.metric_memory->used(), 0U);
}

// Each stage holds as many facet pairs as are admitted, and the answer says what was given up for it.
TEST(FacetPairLimit, HoldsForFloodsOfALargeProminenceAndTheBracketHoldsToo) {
  constexpr double kMostBytes = 250.0;  // of a facet pair (TrackerParameters::facet_pair_limit)
  const auto comb = test::makeBody(test::halvedEdges(test::makeComb(5)), 0.1);
  Eigen::Isometry3d pose(Eigen::AngleAxisd(3.14159265358979323846, Eigen::Vector3d::UnitZ()));
  pose.translation() = Eigen::Vector3d(1.23, 0.65, 0.02);
  TrackerParameters parameters;
  parameters.prominence_limit = 50.0;
  // The bodies build their own parts before.
  PairTracker("pair", comb, comb, parameters).prepare({pose});
  for (const std::uint32_t limit : {8'000U, 16'000U, 24'000U}) {
    parameters.facet_pair_limit = limit;
    const std::size_t before = allocated_bytes;
    most_allocated_bytes = before;
    PairTracker tracker("pair", comb, comb, parameters);
    PairSolution solution;
    for (int k = 0; k < 3; ++k) {
      pose.translation().y() += 1e-3;
      tracker.update(pose, 0.01 * k, solution);
      EXPECT_EQ(solution.status, SolveStatus::MemoryExhausted) << toString(solution.status);
      EXPECT_FALSE(solution.niches_complete);
      const double truth = std::sqrt(test::enumerateTrianglePairs(*comb, *comb, pose).squared_distance);
      EXPECT_LE(solution.lower_bound, truth);
      EXPECT_NEAR(solution.distance, truth, 1e-12) << "the proof needs few";
    }
    // Buffers of fixed size do not grow with the limit.
    EXPECT_LT(static_cast<double>(most_allocated_bytes - before), kMostBytes * limit + 2e6) << limit;
  }
  parameters.prominence_limit = 0.0;
  parameters.facet_pair_limit = TrackerParameters().facet_pair_limit;
  EXPECT_TRUE(solveOnce("pair", comb, comb, parameters, pose).niches_complete);
}

}  // namespace
}  // namespace concave_distance::tracker_memory_test
