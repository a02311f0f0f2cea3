#include "ros/node/distance_cycle.h"
#include "ros/pair_demands.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>

#include "concave_distance/search/prepare_search.h"
#include "ros/box_scene.h"
#include "scene/scene_edits.h"

namespace concave_distance::distance_cycle_test {
namespace {

using test::kDistance;
using test::kIdle;
using test::kNiches;
using test::kRounding;

constexpr PairDemand kNotDue{true, false, true};

class DistanceCycleTest : public ::testing::Test {
 protected:
  DistanceCycleTest() { cycle.setScene(scene); }

  static ros::Time at(int step) { return ros::Time(100, 0) + ros::Duration(0.02 * step); }

  // b in front of a, gap 1; c behind a, gap 2.
  void moveAll(int step) {
    place(buffer, "a", 0.001 * step, at(step));
    place(buffer, "b", 2.0, at(step));
    place(buffer, "c", -3.0, at(step));
  }
  CycleCounts run(int step, PairDemand first, PairDemand second) {
    return cycle.run({first, second}, at(step));
  }
  const PublishedPair& pair(std::size_t index) { return *cycle.pairs()[index]; }
  const TrackedPair& tracked(std::size_t index) { return *pair(index).tracked; }

  TransformBuffer buffer = timelessBuffer();
  Scene scene = threeBoxes();
  DistanceCycle cycle{buffer, {"world", 1.0, 1}};
};

TEST_F(DistanceCycleTest, SolvesWhatIsWatchedAndNothingElse) {
  moveAll(0);
  EXPECT_EQ(run(0, kIdle, kIdle).solved, 0U);
  EXPECT_EQ(tracked(0).tracker(), nullptr) << "not even its memory is taken";
  const CycleCounts report = run(0, kDistance, kIdle);
  EXPECT_EQ(report.watched, 1U);
  EXPECT_EQ(report.solved, 1U);
  EXPECT_EQ(report.cold, 1U);
  EXPECT_NEAR(tracked(0).solution.distance, 1.0, kRounding);
  EXPECT_EQ(tracked(1).tracker(), nullptr);
}

TEST_F(DistanceCycleTest, SolvesNothingMoreWhenTheNodeShutsDown) {
  std::atomic<bool> stop{false};
  DistanceCycle stopped(buffer, {"world", 1.0, 1, &stop});
  stopped.setScene(scene);
  moveAll(0);
  stop = true;
  stopped.run({kNiches, kNiches}, at(0));
  EXPECT_FALSE(stopped.pairs()[0]->tracked->solved());
  EXPECT_EQ(stopped.pairs()[0]->status.code, PairStatus::DISABLED) << "not OK without an answer";
  EXPECT_FALSE(searchPreparationOf(*stopped.pairs()[0]->tracked->body_a->mesh).is_complete)
      << "nor is anything prepared";
}

TEST_F(DistanceCycleTest, RepeatsAnAnswerUntilNewTransformsCome) {
  moveAll(0);
  run(0, kNiches, kIdle);
  const CycleCounts repeated = run(1, kNiches, kIdle);
  EXPECT_EQ(repeated.solved, 0U);
  EXPECT_EQ(repeated.repeated, 1U);
  EXPECT_TRUE(tracked(0).solved());
  EXPECT_EQ(pair(0).heading.stamp, at(0));
  moveAll(1);
  EXPECT_EQ(run(1, kNiches, kIdle).solved, 1U);
  EXPECT_EQ(pair(0).heading.stamp, at(1));
  EXPECT_NEAR(tracked(0).solution.distance, 0.999, kRounding);
  EXPECT_TRUE(tracked(0).solution.warm);
}

TEST_F(DistanceCycleTest, PutsOffNichesAtItsEndAndFinishesThemLater) {
  moveAll(0);
  CycleCounts first;
  do {
    first = cycle.run({kNiches, kDistance}, at(0), WorkLimit::Clock::now());
  } while (first.unprepared > 0);
  EXPECT_EQ(first.put_off, 1U);
  EXPECT_TRUE(tracked(0).put_off);
  EXPECT_FALSE(tracked(0).solution.niches_complete);
  EXPECT_TRUE(tracked(0).solution.niches.empty());
  EXPECT_FALSE(tracked(1).put_off) << "its distance is all that was asked for";
  const auto later = WorkLimit::Clock::now() + std::chrono::hours(1);
  const CycleCounts counts = cycle.run({kNiches, kDistance}, at(0), later);
  EXPECT_EQ(counts.put_off, 0U);
  EXPECT_EQ(counts.solved, 1U) << "without newer transforms, but not done";
  EXPECT_EQ(tracked(0).solution.status, SolveStatus::Ok);
  EXPECT_TRUE(tracked(0).solution.niches_complete);
  EXPECT_EQ(cycle.run({kNiches, kDistance}, at(0), later).repeated, 2U);
}

TEST_F(DistanceCycleTest, SolvesStaticPairsOnce) {
  for (const char* name : {"a", "b", "c"}) {
    place(buffer, name, name[0] == 'a' ? 0.0 : 2.0, at(0), 0.0, true);
  }
  EXPECT_EQ(run(0, kDistance, kDistance).solved, 2U);
  EXPECT_EQ(run(1, kDistance, kDistance).solved, 0U);
  EXPECT_EQ(pair(0).heading.stamp, at(1)) << "a static transform is valid now";
}

TEST_F(DistanceCycleTest, StartsColdAfterAnUnwatchedSpellWithFreshIds) {
  moveAll(0);
  run(0, kNiches, kIdle);
  moveAll(1);
  run(1, kNiches, kIdle);
  ASSERT_TRUE(tracked(0).solution.warm);
  const std::uint64_t largest = tracked(0).largest_id;
  moveAll(2);
  run(2, kNotDue, kIdle);
  moveAll(3);
  run(3, kNiches, kIdle);
  EXPECT_TRUE(tracked(0).solution.warm) << "watched but not due is no unwatched spell";
  run(4, kIdle, kIdle);
  moveAll(5);
  run(5, kNiches, kIdle);
  EXPECT_FALSE(tracked(0).solution.warm);
  for (const TrackedNiche& niche : tracked(0).solution.niches) {
    EXPECT_GT(niche.id, largest);
  }
}

TEST_F(DistanceCycleTest, SolvesAnewWhenNichesAreAskedForBesidesTheDistance) {
  moveAll(0);
  run(0, kDistance, kIdle);
  EXPECT_EQ(run(1, kNiches, kIdle).solved, 1U) << "the answer at hand has no niche properties";
}

TEST_F(DistanceCycleTest, LeavesOtherPairsAloneWhenOneHasNoTransforms) {
  place(buffer, "a", 0.0, at(0));
  place(buffer, "c", -3.0, at(0));
  const CycleCounts report = run(0, kDistance, kDistance);
  EXPECT_EQ(report.not_located, 1U);
  EXPECT_EQ(report.solved, 1U);
  EXPECT_EQ(pair(0).status.code, PairStatus::MISSING_TRANSFORM);
  EXPECT_NE(pair(0).status.message.find("b"), std::string::npos);
  EXPECT_NEAR(tracked(1).solution.distance, 2.0, kRounding);
  place(buffer, "b", 2.0, at(0));
  EXPECT_EQ(run(1, kDistance, kDistance).not_located, 0U);
  EXPECT_TRUE(tracked(0).solved());
}

TEST_F(DistanceCycleTest, DoesNotSolveAtStaleTransforms) {
  moveAll(0);
  run(0, kDistance, kIdle);
  const CycleCounts report = run(60, kDistance, kIdle);
  EXPECT_EQ(report.not_located, 1U);
  EXPECT_EQ(pair(0).status.code, PairStatus::STALE_TRANSFORM);
  EXPECT_FALSE(tracked(0).solved());
  EXPECT_EQ(pair(0).heading.stamp, at(0)) << "the status tells how old they are";
}

TEST_F(DistanceCycleTest, ProvesAPairBeyondTheCutoffInsteadOfSolvingIt) {
  scene.pairs.edit(1).settings.tracker.cutoff = 1.5;
  scene.pairs.edit(1).settings.warning_distance = 0.1;
  cycle.setScene(scene);
  moveAll(0);
  const CycleCounts report = run(0, kDistance, kDistance);
  EXPECT_EQ(report.solved, 1U);
  EXPECT_EQ(report.beyond_cutoff, 1U);
  EXPECT_EQ(pair(1).status.code, PairStatus::BEYOND_CUTOFF);
  ASSERT_TRUE(tracked(1).box_bound.has_value());
  EXPECT_GT(*tracked(1).box_bound, 1.5);
  EXPECT_LE(*tracked(1).box_bound, 2.0);
  EXPECT_EQ(tracked(1).warning.state(), WarningState::Clear) << "a proven bound is known, not unknown";
}

TEST_F(DistanceCycleTest, NeverUsesAnIdAgainWhenABodyComesBackUnderItsName) {
  moveAll(0);
  run(0, kNiches, kIdle);
  const std::uint64_t largest = tracked(0).largest_id;
  ASSERT_GT(largest, 0U);
  cycle.setScene(Scene());
  cycle.setScene(threeBoxes());
  moveAll(1);
  run(1, kNiches, kIdle);
  for (const TrackedNiche& niche : tracked(0).solution.niches) {
    EXPECT_GT(niche.id, largest);
  }
}

TEST_F(DistanceCycleTest, KeepsWarmWhatAnEditOfTheSceneDoesNotTouch) {
  moveAll(0);
  run(0, kNiches, kNiches);
  PairList rest;
  rest.appendShared(scene.pairs, 1);
  scene.pairs = rest;
  cycle.setScene(scene);
  moveAll(1);
  cycle.run({kNiches}, at(1));
  EXPECT_EQ(pair(0).heading.pair, "a/c");
  EXPECT_TRUE(tracked(0).solution.warm);
}

TEST_F(DistanceCycleTest, SolvesNoPairAnewForAnEditThatChangesNoSettings) {
  moveAll(0);
  run(0, kNiches, kNiches);
  cycle.setScene(scene, false);
  EXPECT_EQ(run(1, kNiches, kNiches).repeated, 2U);
  scene.pairs.edit(0).settings.tracker.least_prominence = 0.02;
  cycle.setScene(scene, true);
  EXPECT_EQ(run(2, kNiches, kNiches).solved, 1U) << "the pair whose settings have changed, and no other";
}

TEST_F(DistanceCycleTest, TracksABodyThatCameBackWithinACycleByItsNewSettings) {
  SceneBody crate = unitBox("b");
  PairSettings settings;
  settings.tracker.accuracy = AccuracyLevel::Refined;
  removeBody(scene, "b");
  addBody(scene, crate, {{"a"}}, settings);
  cycle.setScene(scene);
  moveAll(0);
  run(0, kNiches, kNiches);
  ASSERT_EQ(pair(1).heading.pair, "b/a");
  removeBody(scene, "b");
  crate.material.youngs_modulus = 1e6;  // of the same mesh
  settings.tracker.accuracy = AccuracyLevel::Certified;
  addBody(scene, crate, {{"a"}}, settings);
  cycle.setScene(scene, false);
  moveAll(1);
  EXPECT_EQ(run(1, kNiches, kNiches).cold, 1U) << "a/c goes on";
  ASSERT_EQ(pair(1).heading.pair, "b/a");
  EXPECT_EQ(tracked(1).tracker()->parameters().accuracy, AccuracyLevel::Certified);
  EXPECT_EQ(tracked(1).body_a->material.youngs_modulus, 1e6);
}

TEST_F(DistanceCycleTest, TakesBackTheAlertOfAPairThatIsSwitchedOffOrRemoved) {
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    scene.pairs.edit(i).settings.warning_distance = 5.0;
  }
  cycle.setScene(scene);
  moveAll(0);
  run(0, kDistance, kDistance);
  EXPECT_TRUE(tracked(0).warning_changed);
  EXPECT_TRUE(pair(0).heading.warning);
  scene.pairs.edit(0).enabled = false;
  cycle.setScene(scene);
  run(1, kDistance, kDistance);
  EXPECT_TRUE(tracked(0).warning_changed);
  EXPECT_EQ(tracked(0).warning.state(), WarningState::Clear);
  EXPECT_EQ(pair(0).status.code, PairStatus::DISABLED);
  run(2, kDistance, kDistance);
  EXPECT_FALSE(tracked(0).warning_changed) << "reported once";
  cycle.setScene(Scene());
  const auto retired = cycle.takeRetired();
  ASSERT_EQ(retired.size(), 1U);
  EXPECT_EQ(retired[0]->heading.pair, "a/c");
  EXPECT_EQ(retired[0]->tracked->warning.state(), WarningState::Clear);
}

TEST_F(DistanceCycleTest, GivesTheSameAnswersForAnyNumberOfThreads) {
  DistanceCycle parallel(buffer, {"world", 1.0, 2});
  parallel.setScene(scene);
  for (int step = 0; step < 5; ++step) {
    moveAll(step);
    run(step, kNiches, kNiches);
    parallel.run({kNiches, kNiches}, at(step));
    for (std::size_t index = 0; index < 2; ++index) {
      const PairSolution& one = tracked(index).solution;
      const PairSolution& other = parallel.pairs()[index]->tracked->solution;
      EXPECT_EQ(one.distance, other.distance);
      ASSERT_EQ(one.niches.size(), other.niches.size());
      for (std::size_t niche = 0; niche < one.niches.size(); ++niche) {
        EXPECT_EQ(one.niches[niche].id, other.niches[niche].id);
        EXPECT_EQ(one.niches[niche].point_a_in_a, other.niches[niche].point_a_in_a);
      }
    }
  }
}

TEST_F(DistanceCycleTest, RestartsOnRequest) {
  moveAll(0);
  run(0, kNiches, kNiches);
  cycle.restart(0);
  EXPECT_EQ(run(1, kNiches, kNiches).cold, 1U) << "even without new transforms";
  cycle.restart();
  EXPECT_EQ(run(2, kNiches, kNiches).cold, 2U);
}

}  // namespace
}  // namespace concave_distance::distance_cycle_test
