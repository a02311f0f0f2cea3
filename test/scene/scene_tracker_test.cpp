// Many pairs over time, at poses that the caller gives.
#include "concave_distance/scene/scene_tracker.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "concave_distance/base/error.h"
#include "concave_distance/loading/robot_poses.h"
#include "support/box_scene.h"
#include "support/bumpy_ball.h"
#include "support/scene_fixture.h"
#include "support/solution_bytes.h"

namespace concave_distance {
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

TEST_F(SceneTrackerTest, ComputesNoNichesThatNobodyWants) {
  tracker.update(posesAt(0.0), 0.0, {true, true, false, false});
  EXPECT_NEAR(pair(0).solution.distance, 1.0, kRounding);
  EXPECT_EQ(scene.bodies[0].mesh->nodesIfMade(), nullptr) << "a proof needs no search grid";
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

TEST_F(SceneTrackerTest, RefusesPosesOfAnotherNumberOfBodies) {
  EXPECT_THROW(tracker.update(Poses{at(0.0)}, 0.0), std::out_of_range);
}

class RobotPosesTest : public test::SceneTest {};

TEST_F(RobotPosesTest, AreThoseOfTheJointPositions) {
  const std::string urdf = test::robot(
      test::boxLink("a") + test::boxLink("b") +
      "<joint name='turn' type='revolute'><origin xyz='2 0 0'/><parent link='a'/><child link='b'/>"
      "<axis xyz='0 0 1'/><limit lower='-2' upper='2' effort='1' velocity='1'/></joint>");
  Scene scene = loadRobotScene(urdf, "URDF", options);
  scene.bodies.push_back(unitBox("elsewhere"));
  const RobotPoses robot(urdf);
  EXPECT_EQ(robot.jointNames(), std::vector<std::string>{"turn"});
  const auto poses = robot.of(scene, {{"turn", 0.5}});
  ASSERT_EQ(poses.size(), 3U);
  EXPECT_TRUE(poses[0]->isApprox(Eigen::Isometry3d::Identity(), kRounding));
  const Eigen::Isometry3d turned =
      Eigen::Translation3d(2.0, 0.0, 0.0) * Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ());
  EXPECT_TRUE(poses[1]->isApprox(turned, kRounding));
  EXPECT_FALSE(poses[2].has_value()) << "no link of this robot";
  EXPECT_THROW(robot.of(scene, {{"trun", 0.5}}), Error);
}

}  // namespace
}  // namespace concave_distance
