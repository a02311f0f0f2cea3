// Many pairs over time, at poses that the caller gives.
#include "concave_distance/scene/scene_tracker.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <limits>

#include "concave_distance/base/error.h"
#include "support/box_scene.h"
#include "support/random_solids.h"
#include "support/scene_fixture.h"
#include "support/solution_bytes.h"

namespace concave_distance::scene_tracker_test {
namespace {

using Poses = std::vector<std::optional<Eigen::Isometry3d>>;

// Coordinates of order 1, a few operations.
constexpr double kRounding = 1e-12;

Eigen::Isometry3d at(double x) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, 0.0, 0.0));
}

// b in front of a, gap 1 and closing by 1 m/s; c behind a, gap 2.
Poses posesAt(double time) {
  return {at(0.0), at(2.0 - time), at(-3.0)};
}

class SceneTrackerTest : public ::testing::Test {
 protected:
  SceneTrackerTest() { tracker.setScene(scene); }
  const TrackedPair& pair(std::size_t index) { return *tracker.pairs()[index]; }

  Scene scene = threeBoxes();
  SceneTracker tracker;
};

TEST_F(SceneTrackerTest, SolvesEveryPairAtTheGivenPosesAndGoesOnWarm) {
  const CycleCounts first = tracker.update(posesAt(0.0), 0.0);
  EXPECT_EQ(first.solved, 2U);
  EXPECT_EQ(first.cold, 2U);
  const CycleCounts second = tracker.update(posesAt(0.01), 0.01);
  EXPECT_EQ(second.solved, 2U);
  EXPECT_EQ(second.cold, 0U);
  EXPECT_NEAR(pair(0).solution.distance, 0.99, kRounding);
  EXPECT_NEAR(pair(1).solution.distance, 2.0, kRounding);
  ASSERT_FALSE(pair(0).solution.niches.empty());
  EXPECT_NEAR(pair(0).solution.niches.front().closing_speed, 1.0, 1e-9);
}

TEST_F(SceneTrackerTest, GivesTheAnswersOfTheTrackersOfItsPairs) {
  PairTracker alone("a/b", scene.bodies[0].mesh, scene.bodies[1].mesh, scene.pairs[0].settings.tracker);
  PairSolution expected;
  for (int step = 0; step < 5; ++step) {
    const double time = 0.05 * step;
    tracker.update(posesAt(time), time);
    alone.update(*posesAt(time)[1], time, expected);
    EXPECT_EQ(pair(0).solution.distance, expected.distance);
    ASSERT_EQ(pair(0).solution.niches.size(), expected.niches.size());
    for (std::size_t k = 0; k < expected.niches.size(); ++k) {
      EXPECT_EQ(pair(0).solution.niches[k].id, expected.niches[k].id);
      EXPECT_EQ(pair(0).solution.niches[k].point_b_in_a, expected.niches[k].point_b_in_a);
    }
  }
}

TEST_F(SceneTrackerTest, RepeatsAnAnswerForTheSameTime) {
  tracker.update(posesAt(0.0), 0.0);
  EXPECT_EQ(tracker.update(posesAt(0.5), 0.0).repeated, 2U);
  EXPECT_NEAR(pair(0).solution.distance, 1.0, kRounding);
  EXPECT_EQ(tracker.update(posesAt(0.5), 0.5).solved, 2U);
}

TEST_F(SceneTrackerTest, LeavesOutABodyWithoutAPose) {
  Poses poses = posesAt(0.0);
  poses[1].reset();
  const CycleCounts counts = tracker.update(poses, 0.0);
  EXPECT_EQ(counts.not_located, 1U);
  EXPECT_EQ(counts.solved, 1U);
  EXPECT_EQ(pair(0).state, PairState::NotLocated);
  EXPECT_EQ(pair(1).state, PairState::Solved);
}

TEST_F(SceneTrackerTest, SolvesNothingBeyondTheCutoffAndStartsColdWithin) {
  scene.pairs.edit(0).settings.tracker.cutoff = 0.5;
  scene.pairs.edit(0).settings.warning_distance = 0.3;
  tracker.setScene(scene);
  EXPECT_EQ(tracker.update(posesAt(0.0), 0.0).beyond_cutoff, 1U);
  EXPECT_EQ(pair(0).state, PairState::BeyondCutoff);
  ASSERT_TRUE(pair(0).box_bound.has_value());
  EXPECT_GT(*pair(0).box_bound, 0.5);
  EXPECT_EQ(pair(0).warning.state(), WarningState::Clear);
  tracker.update(posesAt(0.8), 0.8);
  EXPECT_NEAR(pair(0).solution.distance, 0.2, kRounding);
  EXPECT_FALSE(pair(0).solution.warm);
  EXPECT_EQ(pair(0).warning.state(), WarningState::Warning);
  EXPECT_TRUE(pair(0).warning_changed);
}

TEST_F(SceneTrackerTest, CutoffAndWarningCountForBodiesWithTheirMargins) {
  Scene padded = scene;
  padded.bodies.edit(0).margin = 0.25;
  padded.bodies.edit(1).margin = 0.35;
  padded.pairs.edit(0).settings.tracker.cutoff = 0.3;
  padded.pairs.edit(0).settings.warning_distance = 0.15;
  tracker.setScene(padded);
  EXPECT_EQ(tracker.update(posesAt(0.0), 0.0).beyond_cutoff, 1U);
  ASSERT_TRUE(pair(0).box_bound.has_value());
  EXPECT_NEAR(*pair(0).box_bound, 0.4, kRounding);
  EXPECT_LE(*pair(0).box_bound, 0.4);
  EXPECT_NEAR(pair(1).solution.distance, 2.0 - 0.25, kRounding);
  tracker.update(posesAt(0.3), 0.3);
  EXPECT_NEAR(pair(0).solution.distance, 0.1, kRounding);
  EXPECT_EQ(pair(0).warning.state(), WarningState::Warning);
  tracker.update(posesAt(0.5), 0.5);
  EXPECT_EQ(pair(0).solution.status, SolveStatus::Penetrating);
  EXPECT_NEAR(pair(0).solution.signed_distance, -0.1, kRounding);
  // Other settings of the pair leave the margins as they are.
  padded.pairs.edit(0).settings.tracker.cutoff = 1.0;
  tracker.setScene(padded);
  tracker.update(posesAt(0.2), 0.6);
  EXPECT_NEAR(pair(0).solution.distance, 0.2, kRounding);
}

TEST_F(SceneTrackerTest, ComputesNoNichesThatNobodyWants) {
  tracker.update(posesAt(0.0), 0.0, {true, true, false, false});
  EXPECT_NEAR(pair(0).solution.distance, 1.0, kRounding);
  EXPECT_EQ(scene.bodies[0].mesh->attachment(), nullptr) << "a proof needs no search grid";
}

TEST_F(SceneTrackerTest, UsesNoIdAgainWhenAPairComesBack) {
  tracker.update(posesAt(0.0), 0.0);
  const std::uint64_t largest = std::max(pair(0).largest_id, pair(1).largest_id);
  ASSERT_GT(largest, 0U);
  tracker.setScene(Scene());
  tracker.setScene(threeBoxes());
  tracker.update(posesAt(0.1), 0.1);
  for (const TrackedNiche& niche : pair(0).solution.niches) EXPECT_GT(niche.id, largest);
}

TEST_F(SceneTrackerTest, GivesTheSameAnswersForAnyNumberOfThreads) {
  SceneTracker serial({1, nullptr});
  serial.setScene(scene);
  for (int step = 0; step < 5; ++step) {
    tracker.update(posesAt(0.05 * step), 0.05 * step);
    serial.update(posesAt(0.05 * step), 0.05 * step);
    for (std::size_t index = 0; index < 2; ++index) {
      EXPECT_EQ(pair(index).solution.distance, serial.pairs()[index]->solution.distance);
      EXPECT_EQ(pair(index).solution.niches.size(), serial.pairs()[index]->solution.niches.size());
    }
  }
}

struct Answers {
  test::Bytes bytes;
  double helper_cpu_seconds = 0.0;
};

Answers solveLongPair(const Scene& scene, std::uint32_t threads) {
  const tbb::global_control workers(tbb::global_control::max_allowed_parallelism, 2);
  SceneTracker tracker({threads, nullptr});
  tracker.setScene(scene);
  Answers answers;
  for (int step = 0; step < 6; ++step) {
    const CycleCounts counts = tracker.update({at(0.0), at(0.95 + 0.01 * step)}, 0.01 * step);
    answers.helper_cpu_seconds += counts.helper_cpu_seconds;
    test::appendSolution(tracker.pairs()[0]->solution, answers.bytes);
  }
  return answers;
}

TEST(SceneTrackerThreads, HelpWithALongPairOnlyWhereMoreThanOneIsAllowed) {
  Scene long_pair;
  for (const char* name : {"a", "b"}) {
    SceneBody body = unitBox(name);
    BodyMeshOptions options;
    options.max_edge_length = 0.1;
    body.mesh = std::make_shared<const BodyMesh>(name, test::makeBumpyBall(0.4, 1e-3, 9.0), options);
    body.bounds = boundsOf(body.mesh->surface());
    long_pair.bodies.push_back(body);
  }
  long_pair.pairs.push_back(threeBoxes().pairs[0]);
  const Answers alone = solveLongPair(long_pair, 1);
  const Answers together = solveLongPair(long_pair, 2);
  EXPECT_TRUE(together.bytes == alone.bytes);
  EXPECT_EQ(alone.helper_cpu_seconds, 0.0);
}

// Whoever reads the answer without looking at the state must not read that of another pose.
TEST_F(SceneTrackerTest, LeavesNoOldAnswerWhereAPairHasNone) {
  Scene near = threeBoxes();
  for (std::size_t index = 0; index < near.pairs.size(); ++index) {
    near.pairs.edit(index).settings.tracker.cutoff = 1.5;
    near.pairs.edit(index).settings.effects.normal_force.emplace();
  }
  std::atomic<bool> stop{false};
  SceneTracker cut({1, &stop});
  cut.setScene(near);
  const auto expect_nothing = [&](PairState state) {
    const TrackedPair& pair = *cut.pairs()[0];
    EXPECT_EQ(pair.state, state);
    EXPECT_TRUE(std::isnan(pair.solution.distance));
    EXPECT_TRUE(std::isnan(pair.solution.lower_bound));
    EXPECT_TRUE(std::isnan(pair.solution.point_a_in_a.x()));
    EXPECT_TRUE(pair.solution.niches.empty());
    if (pair.effects.contacts() != nullptr) {
      EXPECT_TRUE(pair.effects.contacts()->regions.empty());
      EXPECT_TRUE(std::isnan(pair.effects.contacts()->on_b_in_a.force.x()));
    }
  };
  double time = 0.0;
  const auto touch = [&] {
    stop = false;
    cut.update({at(0.0), at(0.9), at(-3.0)}, ++time, {true, true, true, true});
    ASSERT_EQ(cut.pairs()[0]->solution.distance, 0.0);
    ASSERT_GT(cut.pairs()[0]->effects.contacts()->on_b_in_a.force.x(), 0.0);
  };
  touch();
  cut.update({at(0.0), at(9.0), at(-3.0)}, ++time, {true, true, true, true});
  expect_nothing(PairState::BeyondCutoff);
  touch();
  cut.update({at(0.0), std::nullopt, at(-3.0)}, ++time, {true, true, true, true});
  expect_nothing(PairState::NotLocated);
  touch();
  stop = true;
  const CycleCounts stopped = cut.update({at(0.0), at(0.8), at(-3.0)}, ++time, {true, true, true, true});
  EXPECT_EQ(stopped.solved, 0U);
  expect_nothing(PairState::Stopped);
  touch();
  cut.restart(0);
  expect_nothing(PairState::NotWatched);
  touch();
  cut.update({at(0.0), at(0.9), at(-3.0)}, ++time, PairDemand{});
  expect_nothing(PairState::NotWatched);
}

std::string messageOf(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST_F(SceneTrackerTest, RefusesAnotherNumberOfPosesByName) {
  for (const Poses& poses : {Poses{}, Poses{at(0.0)}, Poses(4, at(0.0))}) {
    EXPECT_TRUE(test::mentions(messageOf([&] { tracker.update(poses, 0.0); }),
                               std::to_string(poses.size()) + " poses for 3 bodies"));
  }
  EXPECT_TRUE(test::mentions(messageOf([&] { tracker.restart(2); }), "pair 2 of 2"));
  EXPECT_EQ(tracker.update(posesAt(0.0), 0.0).solved, 2U);
}

TEST_F(SceneTrackerTest, RefusesPairsThatAreNotTwoBodiesWithMeshesAndKeepsTheSceneBefore) {
  const auto message = [&](std::size_t body_a, std::size_t body_b) {
    Scene wrong = threeBoxes();
    SceneBody bare;
    bare.name = "bare";
    wrong.bodies.push_back(bare);
    wrong.pairs.edit(1).body_a = body_a;
    wrong.pairs.edit(1).body_b = body_b;
    return messageOf([&] { tracker.setScene(wrong); });
  };
  EXPECT_TRUE(test::mentions(message(0, 4), "pair 'a/c': it names body 4 of 4"));
  EXPECT_TRUE(test::mentions(message(std::numeric_limits<std::size_t>::max(), 1), "of 4"));
  EXPECT_TRUE(test::mentions(message(0, 3), "body 'bare' has no mesh"));
  EXPECT_TRUE(test::mentions(message(2, 2), "both its bodies are 'c'"));
  EXPECT_EQ(tracker.update(posesAt(0.0), 0.0).solved, 2U);
}

TEST_F(SceneTrackerTest, FollowsABodyThatIsExchangedInItsPlace) {
  tracker.update(posesAt(0.0), 0.0);
  SceneBody& body = scene.bodies.edit(1);
  body.mesh =
      std::make_shared<const BodyMesh>("b", makeBox(Eigen::Vector3d(2.0, 1.0, 1.0)), BodyMeshOptions{});
  body.bounds = boundsOf(body.mesh->surface());
  tracker.setScene(scene);
  tracker.update(posesAt(0.0), 0.0);
  EXPECT_NEAR(pair(0).solution.distance, 0.5, kRounding);
}

}  // namespace
}  // namespace concave_distance::scene_tracker_test
