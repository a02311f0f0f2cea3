// A recorder keeps of the cycles of a pair its poses to the last bit, its answers, its gaps.
#include "scene/pair_recorder.h"

#include <gtest/gtest.h>

#include <cstring>
#include <thread>

#include "support/count_allocations.h"
#include "support/recorded_pair.h"

namespace concave_distance::pair_recorder_test {
namespace {

using Eigen::Isometry3d;
using test::RecordedPair;

constexpr PairDemand kDistance{true, true, false, false};

class PairRecorderTest : public ::testing::Test {
 protected:
  static std::unique_ptr<RecordedPair> make(std::uint32_t length, const PairSettings& settings = {}) {
    return std::make_unique<RecordedPair>(test::bodyOf("comb", test::meshOf("comb", test::makeComb(3))),
                                          test::bodyOf("hook", test::meshOf("hook", test::makeHook())),
                                          settings, length);
  }
  static bool isSame(const Isometry3d& l, const Isometry3d& r) {
    return std::memcmp(l.data(), r.data(), 16 * sizeof(double)) == 0;
  }

  const test::Motion motion = test::passingMotion();
};

TEST_F(PairRecorderTest, KeepsTheLastPosesAsTheTrackerGotThem) {
  const auto pair(make(5));
  std::vector<Isometry3d> poses;
  std::vector<PairSolution> answers;
  for (int k = 0; k < 12; ++k) {
    pair->run(0.02 * k, motion.at(0.02 * k));
    poses.push_back(pair->tracked().input.a_from_b);
    answers.push_back(pair->tracked().solution);
    const auto recording = pair->take();
    ASSERT_TRUE(recording);
    ASSERT_EQ(recording->cycles.size(), std::min<std::size_t>(poses.size(), 5));
    for (std::size_t i = 0; i < recording->cycles.size(); ++i) {
      const RecordedCycle& cycle = recording->cycles[i];
      const std::size_t at = poses.size() - recording->cycles.size() + i;
      EXPECT_TRUE(isSame(cycle.pose(), poses[at]));
      EXPECT_EQ(cycle.time, 0.02 * static_cast<double>(at));
      EXPECT_EQ(cycle.distance, answers[at].distance);
      EXPECT_EQ(cycle.lower_bound, answers[at].lower_bound);
      EXPECT_EQ(cycle.niche_count, answers[at].niches.size());
      EXPECT_TRUE(cycle.with_niches);
    }
    EXPECT_EQ(recording->epoch, RecordedPair::kEpoch);
    EXPECT_EQ(recording->pair->name, "comb/hook");
    EXPECT_FALSE(recording->last_answer) << "no cycle came while it waited";
  }
  EXPECT_EQ(pair->take(2)->cycles.size(), 2U);
  EXPECT_EQ(pair->take(2)->cycles.back().time, 0.02 * 11);
}

TEST_F(PairRecorderTest, CountsCyclesWithoutAPoseAndLeavesOutRepeatedOnes) {
  const auto pair(make(10));
  pair->run(0.0, std::nullopt);
  ASSERT_TRUE(pair->take());
  EXPECT_TRUE(pair->take()->cycles.empty());
  EXPECT_EQ(pair->take()->missed_after, 1U);
  pair->run(0.1, motion.at(0.1));
  pair->run(0.1, motion.at(0.1));
  pair->run(0.2, std::nullopt);
  pair->run(0.3, std::nullopt);
  pair->run(0.4, motion.at(0.4));
  pair->run(0.5, std::nullopt);
  const auto recording = pair->take();
  ASSERT_EQ(recording->cycles.size(), 2U);
  EXPECT_EQ(recording->cycles[0].missed_before, 1U);
  EXPECT_EQ(recording->cycles[1].missed_before, 2U);
  EXPECT_EQ(recording->missed_after, 1U);
}

TEST_F(PairRecorderTest, TakesTheAnswerOfACycleThatGoesOnAtTheSamePose) {
  const auto pair(make(10));
  pair->run(0.1, motion.at(0.1), kDistance);
  EXPECT_FALSE(pair->take()->cycles.back().with_niches);
  pair->run(0.1, motion.at(0.1));
  const auto recording = pair->take();
  ASSERT_EQ(recording->cycles.size(), 1U);
  EXPECT_TRUE(recording->cycles.back().with_niches);
  EXPECT_GT(recording->cycles.back().niche_count, 0U);
}

TEST_F(PairRecorderTest, BeginsAnewWhenTheClockJumpsBack) {
  const auto pair(make(10));
  pair->run(motion, 4);
  pair->run(0.01, motion.at(0.01));
  ASSERT_EQ(pair->take()->cycles.size(), 1U);
  EXPECT_EQ(pair->take()->cycles.front().time, 0.01);
}

TEST_F(PairRecorderTest, BeginsAnewWithAnotherMeshAndGoesOnWithOtherSettings) {
  const auto pair(make(10));
  pair->run(motion, 4);
  pair->scene.pairs.edit(0).settings.tracker.cutoff = 7.0;
  pair->tracker.setScene(pair->scene);
  pair->run(0.1, motion.at(0.1));
  ASSERT_EQ(pair->take()->cycles.size(), 5U);
  EXPECT_EQ(pair->take()->pair->settings.tracker.cutoff, 7.0);
  pair->scene.bodies.edit(1).mesh = test::meshOf("hook", test::makeHook(0.9));
  pair->tracker.setScene(pair->scene);
  pair->run(0.2, motion.at(0.2));
  ASSERT_EQ(pair->take()->cycles.size(), 1U);
  EXPECT_EQ(pair->take()->body_b->mesh, pair->scene.bodies[1].mesh);
}

TEST_F(PairRecorderTest, KeepsPosesBeyondTheCutoffOfAPairThatWasNearer) {
  PairSettings settings;
  settings.tracker.cutoff = 2.0;
  const auto pair(make(10, settings));
  const Isometry3d far(Eigen::Translation3d(9, 0, 0));
  pair->run(0.0, far);
  EXPECT_TRUE(pair->take()->cycles.empty()) << "a pair that was never near costs no memory";
  pair->run(0.1, motion.at(0.1));
  pair->run(0.2, far);
  const auto recording = pair->take();
  ASSERT_EQ(recording->cycles.size(), 2U);
  EXPECT_EQ(recording->cycles[1].state, PairState::BeyondCutoff);
  EXPECT_EQ(recording->cycles[1].lower_bound, pair->tracked().box_bound);
  EXPECT_TRUE(std::isnan(recording->cycles[1].distance));
}

TEST_F(PairRecorderTest, ForgetsPairsThatAreGoneAndFindsTheOthers) {
  Scene scene;
  for (const char* name : {"a", "b", "c"})
    scene.bodies.push_back(test::bodyOf(name, test::meshOf(name, test::makeComb(2))));
  const auto add = [&](std::size_t a, std::size_t b) {
    ScenePair pair;
    pair.name = scene.bodies[a].name + "/" + scene.bodies[b].name;
    pair.body_a = a;
    pair.body_b = b;
    scene.pairs.push_back(pair);
  };
  add(0, 1);
  add(1, 2);
  SceneTracker tracker({1});
  PairRecorder recorder(8);
  double time = 0.0;
  const auto cycle = [&] {
    time += 0.1;
    tracker.setScene(scene);
    tracker.update({Isometry3d::Identity(), Isometry3d(Eigen::Translation3d(2 + time, 0, 0)),
                    Isometry3d(Eigen::Translation3d(5, 0, 0))},
                   time);
    recorder.record(tracker.pairs(), 0);
  };
  const auto cyclesOf = [&](std::size_t a, std::size_t b) {
    const auto recording = recorder.take(scene.bodies[a].serial, scene.bodies[b].serial, 8, {});
    return recording ? static_cast<int>(recording->cycles.size()) : -1;
  };
  cycle();
  cycle();
  EXPECT_EQ(cyclesOf(0, 1), 2);
  EXPECT_EQ(cyclesOf(2, 1), 2);
  EXPECT_EQ(cyclesOf(0, 2), -1) << "no such pair";
  PairList rest;
  rest.appendShared(scene.pairs, 1);
  scene.pairs = rest;
  cycle();
  EXPECT_EQ(cyclesOf(0, 1), -1);
  EXPECT_EQ(cyclesOf(1, 2), 3);
  add(0, 1);
  cycle();
  EXPECT_EQ(cyclesOf(0, 1), 1);
  EXPECT_EQ(cyclesOf(1, 2), 4);
}

TEST_F(PairRecorderTest, GivesTheWholeAnswerOfTheCycleThatItWaitsFor) {
  const auto pair(make(10));
  pair->run(motion, 3);
  std::optional<PairRecording> recording;
  std::atomic<bool> has_it{false};
  std::thread waiting([&] {
    recording = pair->recorder.take(pair->scene.bodies[0].serial, pair->scene.bodies[1].serial, 10,
                                    std::chrono::minutes(1));
    has_it = true;
  });
  for (int k = 3; !has_it; ++k) pair->run(0.02 * k, motion.at(0.02 * k));
  waiting.join();
  ASSERT_TRUE(recording && recording->last_answer);
  const RecordedCycle& last = recording->cycles.back();
  EXPECT_EQ(recording->last_answer->niches.size(), last.niche_count);
  EXPECT_GT(last.niche_count, 0U);
}

TEST_F(PairRecorderTest, AllocatesNothingInAWarmCycle) {
  const auto pair(make(8));
  pair->run(motion, 3);
  for (int k = 3; k < 30; ++k) {
    const Isometry3d pose = motion.at(0.02 * k);
    pair->tracker.update({Isometry3d::Identity(), pose}, 0.02 * k);
    const std::size_t before = allocations;
    pair->recorder.record(pair->tracker.pairs(), 0);
    EXPECT_EQ(allocations, before);
  }
  EXPECT_EQ(pair->take()->cycles.size(), 8U);
}

TEST_F(PairRecorderTest, SaysWhenItsMemoryIsUsedUp) {
  const auto pair(make(8));
  PairRecorder small(8, 8 * sizeof(RecordedCycle) - 1);
  PairRecorder none(0);
  pair->run(motion, 3);
  small.record(pair->tracker.pairs(), 0);
  none.record(pair->tracker.pairs(), 0);
  const auto a = pair->scene.bodies[0].serial;
  const auto b = pair->scene.bodies[1].serial;
  ASSERT_TRUE(small.take(a, b, 8, {}));
  EXPECT_FALSE(small.take(a, b, 8, {})->has_room);
  EXPECT_TRUE(small.take(a, b, 8, {})->cycles.empty());
  EXPECT_FALSE(none.take(a, b, 8, {}));
}

}  // namespace
}  // namespace concave_distance::pair_recorder_test
