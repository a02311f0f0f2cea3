// Memory runs out at each allocation of a cycle and of a query in turn.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "concave_distance/tracking/pair_tracker.h"
#include "ros/box_scene.h"
#include "ros/node/distance_cycle.h"
#include "ros/pair_demands.h"
#include "ros/services/answer_query.h"
#include "support/body_pairs.h"
#include "support/concave_shapes.h"
#include "support/fail_allocations.h"

namespace concave_distance::out_of_memory_test {
namespace {

using test::kDistance;
using test::kIdle;
using test::kRounding;

/// @return whether `act` ended by std::bad_alloc
bool failsAfter(std::size_t allocations, const std::function<void()>& act) {
  try {
    const FailingAllocations failing(allocations);
    act();
  } catch (const std::bad_alloc&) {
    return true;
  }
  return false;
}

/// Whether memory ran out inside the solve of a pair.
bool isWithoutMemory(const PairSolution& solution) {
  return solution.status == SolveStatus::MemoryExhausted;
}

/// Where a, b and c are on the x axis.
std::vector<std::optional<Eigen::Isometry3d>> posesAt(const std::array<double, 3>& places) {
  std::vector<std::optional<Eigen::Isometry3d>> poses;
  for (const double x : places) poses.emplace_back(Eigen::Translation3d(x, 0.0, 0.0));
  return poses;
}

class OutOfMemoryTest : public ::testing::Test {
 protected:
  static ros::Time at(int step) { return ros::Time(100, 0) + ros::Duration(0.02 * step); }
  // b in front of a, gap 1; c behind a, gap 2.
  void moveAll(int step) {
    place(buffer, "a", 1e-5 * step, at(step));
    place(buffer, "b", 2.0, at(step));
    place(buffer, "c", -3.0, at(step));
  }

  TransformBuffer buffer = timelessBuffer();
  Scene scene = threeBoxes();
};

TEST_F(OutOfMemoryTest, ACycleThatCannotAdoptASceneFollowsTheOneBefore) {
  Scene turned;  // c/a is new, a/b stays, a/c leaves
  turned.bodies = scene.bodies;
  ScenePair pair = scene.pairs[1];
  pair.name = "c/a";
  turned.pairs.push_back(pair);
  turned.pairs.appendShared(scene.pairs, 0);
  scene.pairs.edit(1).settings.warning_distance = 5.0;

  DistanceCycle cycle(buffer, {"world", 1.0, 1});
  cycle.setScene(scene);
  moveAll(0);
  cycle.run({kDistance, kDistance}, at(0));
  std::size_t failures = 0;
  while (failsAfter(failures, [&] { cycle.setScene(turned); })) {
    ++failures;
    ASSERT_EQ(cycle.pairs().size(), 2U);
    ASSERT_TRUE(std::all_of(cycle.pairs().begin(), cycle.pairs().end(),
                            [](const auto& tracked) { return tracked != nullptr; }))
        << "after " << failures << " allocations";
    EXPECT_EQ(cycle.pairs()[1]->heading.pair, "a/c");
    EXPECT_TRUE(cycle.takeRetired().empty());
    cycle.run({kDistance, kDistance}, at(0));
    EXPECT_NEAR(cycle.pairs()[0]->tracked->solution.distance, 1.0, kRounding);
    EXPECT_NEAR(cycle.pairs()[1]->tracked->solution.distance, 2.0, kRounding);
  }
  EXPECT_GT(failures, 5U);
  EXPECT_EQ(cycle.pairs()[0]->heading.pair, "c/a");
  EXPECT_EQ(cycle.pairs()[1]->heading.pair, "a/b");
  EXPECT_EQ(cycle.takeRetired().size(), 1U) << "the alert of a/c is taken back";
  moveAll(1);
  EXPECT_EQ(cycle.run({kDistance, kDistance}, at(1)).solved, 2U);
}

TEST_F(OutOfMemoryTest, ACycleAfterOneThatFailedGivesNoOldDistanceUnderANewStamp) {
  const std::vector<PairDemand> both = {kDistance, kDistance};
  std::size_t failures = 0;
  for (bool failed = true; failed; ++failures) {
    const int step = 2 * static_cast<int>(failures);
    DistanceCycle cycle(buffer, {"world", 1.0, 1});
    cycle.setScene(scene);
    moveAll(step);
    cycle.run({kDistance, kIdle}, at(step));
    moveAll(step + 1);
    failed = failsAfter(failures, [&] { cycle.run(both, at(step + 1)); });
    const PublishedPair& pair = *cycle.pairs()[0];
    failed = failed || isWithoutMemory(pair.tracked->solution);
    cycle.run({kDistance, kDistance}, at(step + 1));
    EXPECT_EQ(pair.heading.stamp, at(step + 1));
    ASSERT_TRUE(pair.tracked->solved());
    ASSERT_NEAR(pair.tracked->solution.distance, 1.0 - 1e-5 * (step + 1), kRounding)
        << "after " << failures << " allocations";
    EXPECT_TRUE(pair.tracked->solution.warm || failed);
  }
  EXPECT_GT(failures, 20U);
}

TEST_F(OutOfMemoryTest, ATrackerThatWasInterruptedStartsCold) {
  const std::vector<std::optional<Eigen::Isometry3d>> first = posesAt({0.0, 2.0, -3.0});
  const std::vector<std::optional<Eigen::Isometry3d>> second = posesAt({1e-5, 2.0, -3.0});
  std::size_t failures = 0;
  for (bool failed = true; failed; ++failures) {
    SceneTracker tracker({1, nullptr});
    tracker.setScene(scene);
    tracker.update(first, 0.0, {true, true, false, false});
    failed = failsAfter(failures, [&] { tracker.update(second, 0.1, {true, true, true, false}); });
    std::vector<bool> was_ended;
    for (const auto& pair : tracker.pairs()) was_ended.push_back(failed || isWithoutMemory(pair->solution));
    failed = std::find(was_ended.begin(), was_ended.end(), true) != was_ended.end();
    tracker.update(second, 0.2, {true, true, true, false});
    for (std::size_t i = 0; i < tracker.pairs().size(); ++i) {
      ASSERT_TRUE(tracker.pairs()[i]->solved());
      EXPECT_EQ(tracker.pairs()[i]->solution.warm, !was_ended[i]) << "after " << failures << " allocations";
    }
  }
  EXPECT_GT(failures, 20U);
}

TEST_F(OutOfMemoryTest, AQueryIsAnsweredWithoutAThrow) {
  moveAll(0);
  DistanceQuery query;
  query.body_a = "a";
  query.body_b = "b";
  const QueryContext context{&buffer, "world", 0.0, 1.0};
  std::size_t failures = 0;
  for (bool answered = false; !answered; ++failures) {
    QueryAnswer answer;
    ASSERT_FALSE(failsAfter(failures, [&] { answer = answerQuery(query, scene, context, at(0)); }));
    const PairDistance& nearest = answer.result.nearest;
    answered = nearest.status.code == PairStatus::OK;
    if (nearest.status.code == PairStatus::MEMORY_EXHAUSTED) {
      EXPECT_TRUE(isAnswered(answer.result));
      EXPECT_LE(nearest.lower_bound, 1.0);
      EXPECT_GE(nearest.distance, 1.0 - kRounding);
      continue;
    }
    EXPECT_EQ(nearest.status.code, answered ? PairStatus::OK : PairStatus::INVALID_REQUEST);
    EXPECT_EQ(std::isnan(nearest.distance), !answered);
    EXPECT_NE(nearest.status.message.empty(), !answered);
  }
  EXPECT_GT(failures, 20U);
}

// Memory runs out inside the solve: at any level the tracker answers by a bracket and begins anew.
TEST(OutOfMemory, ASolveEndsWithABracketThatHolds) {
  const auto comb = test::makeBody(test::makeComb(3));
  const Eigen::Isometry3d pose = Eigen::Translation3d(0.2, 0.1, 2.5) * Eigen::Isometry3d::Identity();
  for (const AccuracyLevel accuracy :
       {AccuracyLevel::Certified, AccuracyLevel::Refined, AccuracyLevel::Nodes}) {
    TrackerParameters parameters;
    parameters.accuracy = accuracy;
    parameters.margin_a = 0.1;
    const PairSolution expected = solveOnce("pair", comb, comb, parameters, pose);
    std::size_t exhausted = 0;
    std::size_t succeeding = 0;
    for (bool is_whole = false; !is_whole; succeeding += 1 + succeeding / 16) {
      PairTracker tracker("pair", comb, comb, parameters);
      PairSolution solution;
      ASSERT_FALSE(failsAfter(succeeding, [&] { tracker.update(pose, 0.0, solution); })) << succeeding;
      is_whole = !isWithoutMemory(solution);
      exhausted += is_whole ? 0 : 1;
      EXPECT_EQ(solution.niches_complete, is_whole && expected.niches_complete);
      EXPECT_GE(solution.distance, expected.distance - kRounding);
      if (provesDistance(accuracy)) {
        EXPECT_LE(solution.lower_bound, expected.distance);
      }
      EXPECT_NEAR((solution.point_b_in_a - solution.point_a_in_a).norm(), solution.distance, kRounding);
      tracker.update(pose, 0.1, solution);
      EXPECT_EQ(solution.warm, is_whole);
      EXPECT_NE(solution.status, SolveStatus::MemoryExhausted);
      if (provesDistance(accuracy)) {
        EXPECT_EQ(solution.distance, expected.distance);
        EXPECT_EQ(solution.niches.size(), expected.niches.size());
      }
    }
    EXPECT_GT(exhausted, 10U) << toString(accuracy);
  }
}

}  // namespace
}  // namespace concave_distance::out_of_memory_test
