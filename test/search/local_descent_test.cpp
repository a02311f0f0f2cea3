#include "search/local_descent.h"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include "search/grid/body_grid.h"
#include "search/mutation.h"
#include "search/search_scenes.h"

namespace concave_distance::local_descent_test {
namespace {

bool isLocalMinimum(const PairObjective& objective, const TrialPoint& point) {
  const double reached = objective.squaredDistance(point.node_a, point.node_b);
  for (const NodeGraph::Edge& edge : objective.gridA().graph().edges.row(point.node_a.value)) {
    if (objective.squaredDistance(edge.to, point.node_b) < reached) {
      return false;
    }
  }
  for (const NodeGraph::Edge& edge : objective.gridB().graph().edges.row(point.node_b.value)) {
    if (objective.squaredDistance(point.node_a, edge.to) < reached) {
      return false;
    }
  }
  return true;
}

/// The thesis's procedure, step by step, all in A's frame.
TrialPoint descendPlainly(const PairObjective& objective, TrialPoint point) {
  point.squared_distance = objective.squaredDistance(point.node_a, point.node_b);
  const auto step = [&](const NodeGraph& graph, NodeIndex& node) {
    const NodeIndex start = node;
    for (const NodeGraph::Edge& edge : graph.edges.row(start.value)) {
      const NodeIndex kept = node;
      node = edge.to;
      const double candidate = objective.squaredDistance(point.node_a, point.node_b);
      if (candidate < point.squared_distance) {
        point.squared_distance = candidate;
      } else {
        node = kept;
      }
    }
    return node != start;
  };
  bool moved = true;
  while (moved) {
    moved = false;
    while (step(objective.gridA().graph(), point.node_a)) {
      moved = true;
    }
    while (step(objective.gridB().graph(), point.node_b)) {
      moved = true;
    }
  }
  return point;
}

Eigen::Isometry3d drawPose() {
  const auto draw = [](int range) { return 1e-3 * *rc::gen::inRange(-range, range); };
  const Eigen::Quaterniond turn(draw(1000) + 1e-6, draw(1000), draw(1000), draw(1000));
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = turn.normalized().toRotationMatrix();
  pose.translation() << draw(3000), draw(3000), draw(3000);
  return pose;
}

RC_GTEST_PROP(LocalDescent, EndsAtADiscreteLocalMinimumWithItsDistance, ()) {
  static const test::PairScene kScenes[] = {test::facingCombs(), test::shellsAndShells()};
  const test::PairScene& scene = kScenes[*rc::gen::inRange(0, 2)];
  const PairObjective objective(*scene.a, *scene.b, drawPose());
  RandomEngine engine(*rc::gen::arbitrary<std::uint64_t>());
  std::vector<std::uint64_t> trail;
  SearchCost cost;
  BasinMemory memory;
  for (int i = 0; i < 20; ++i) {
    const TrialPoint start = randomTrialPoint(objective, engine);
    for (BasinMemory* basins : {static_cast<BasinMemory*>(nullptr), &memory}) {
      const TrialPoint end = descend(objective, start, basins, trail, cost);
      RC_ASSERT(isLocalMinimum(objective, end));
      RC_ASSERT(end.squared_distance == objective.squaredDistance(end.node_a, end.node_b));
      RC_ASSERT(end.squared_distance <= objective.squaredDistance(start.node_a, start.node_b));
    }
  }
}

// Faces in parallel: whole plateaus of node pairs differ by nothing but rounding, each frame its own.
TEST(LocalDescent, EndsOnParallelFacesToo) {
  const auto a = test::makeSearchBody(test::makeStairs(4), 0.05);
  const auto b = test::makeSearchBody(test::makeStairs(4), 0.05);
  RandomEngine engine(5);
  std::vector<std::uint64_t> trail;
  SearchCost cost;
  for (const double shift : {0.0, 0.1, 1.0 / 3.0}) {
    const PairObjective objective(*a, *b, test::makePose(0.0, {1, 0, 0}, {shift, 0.7, shift}));
    for (int i = 0; i < 300; ++i) {
      const TrialPoint end = descend(objective, randomTrialPoint(objective, engine), nullptr, trail, cost);
      EXPECT_TRUE(isLocalMinimum(objective, end));
    }
  }
}

// A kilometre away the walk in float sees nothing but noise; the answer must not depend on it.
TEST(LocalDescent, EndsAtALocalMinimumAlsoWhereFloatResolvesNothing) {
  const test::PairScene scene = test::facingCombs();
  RandomEngine engine(6);
  std::vector<std::uint64_t> trail;
  SearchCost cost;
  for (const double away : {1e2, 1e4, 1e6}) {
    const PairObjective objective(*scene.a, *scene.b, test::makePose(1.0, {1, 1, 0}, {away, away, 0.0}));
    for (int i = 0; i < 50; ++i) {
      const TrialPoint end = descend(objective, randomTrialPoint(objective, engine), nullptr, trail, cost);
      EXPECT_TRUE(isLocalMinimum(objective, end));
    }
  }
}

TEST(LocalDescent, EndsWhereThePlainProcedureEnds) {
  const test::PairScene scene = test::hookAndStairs();
  const PairObjective objective(*scene.a, *scene.b, scene.a_from_b);
  RandomEngine engine(7);
  std::vector<std::uint64_t> trail;
  SearchCost cost;
  int same = 0;
  constexpr int kDescents = 1000;
  for (int i = 0; i < kDescents; ++i) {
    const TrialPoint start = randomTrialPoint(objective, engine);
    const TrialPoint expected = descendPlainly(objective, start);
    same += samePlace(descend(objective, start, nullptr, trail, cost), expected) ? 1 : 0;
  }
  // The walk chooses in float: where two neighbours differ by less than 2^-20 it may take the other one.
  EXPECT_GE(same, kDescents * 98 / 100);
}

TEST(LocalDescent, IsAFunctionOfItsStart) {
  const test::PairScene scene = test::facingCombs();
  const PairObjective objective(*scene.a, *scene.b, scene.a_from_b);
  std::vector<std::uint64_t> trail;
  SearchCost cost;
  RandomEngine engine(8);
  for (int i = 0; i < 100; ++i) {
    TrialPoint start = randomTrialPoint(objective, engine);
    const TrialPoint first = descend(objective, start, nullptr, trail, cost);
    start.squared_distance = 17.0;  // not read
    EXPECT_TRUE(samePlace(descend(objective, start, nullptr, trail, cost), first));
  }
}

TEST(LocalDescent, AStartDescendedAlreadyCostsNothingMore) {
  const test::PairScene scene = test::facingCombs();
  const PairObjective objective(*scene.a, *scene.b, scene.a_from_b);
  RandomEngine engine(9);
  std::vector<std::uint64_t> trail;
  BasinMemory memory;
  SearchCost cost;
  std::vector<TrialPoint> starts;
  std::vector<TrialPoint> ends;
  for (int i = 0; i < 200; ++i) {
    starts.push_back(randomTrialPoint(objective, engine));
    ends.push_back(descend(objective, starts.back(), &memory, trail, cost));
  }
  EXPECT_GT(cost.descents_joined, 0U) << "descents into one basin should meet before its minimum";
  const SearchCost before = cost;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    EXPECT_TRUE(samePlace(descend(objective, starts[i], &memory, trail, cost), ends[i]));
    EXPECT_TRUE(samePlace(descend(objective, ends[i], &memory, trail, cost), ends[i]));
  }
  EXPECT_EQ(cost.evaluations, before.evaluations);
  EXPECT_EQ(cost.descents_joined - before.descents_joined, 2 * starts.size());
}

TEST(LocalDescent, MemoryListsEveryMinimumOnce) {
  const test::PairScene scene = test::facingCombs();
  const PairObjective objective(*scene.a, *scene.b, scene.a_from_b);
  RandomEngine engine(10);
  std::vector<std::uint64_t> trail;
  BasinMemory memory(2);  // has to grow
  SearchCost cost;
  for (int i = 0; i < 500; ++i) {
    const TrialPoint end = descend(objective, randomTrialPoint(objective, engine), &memory, trail, cost);
    const std::int64_t index = memory.find(end.node_a, end.node_b);
    ASSERT_GE(index, 0);
    EXPECT_TRUE(samePlace(memory.minima()[static_cast<std::size_t>(index)], end));
  }
  for (std::size_t i = 0; i < memory.minima().size(); ++i) {
    EXPECT_EQ(memory.find(memory.minima()[i].node_a, memory.minima()[i].node_b),
              static_cast<std::int64_t>(i));
  }
  memory.clear();
  EXPECT_TRUE(memory.minima().empty());
  EXPECT_EQ(memory.find(NodeIndex{0}, NodeIndex{0}), -1);
}

}  // namespace
}  // namespace concave_distance::local_descent_test
