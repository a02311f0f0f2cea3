#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <optional>
#include <vector>

#include "concave_distance/scene/scene_tracker.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "support/box_scene.h"
#include "support/concave_shapes.h"
#include "support/count_allocations.h"
#include "support/thesis_scenes.h"
#include "tracking/effect_scene.h"

namespace concave_distance::tracker_allocation_test {
namespace {

// Buffers have grown to what a motion needs when it has been run once: the same motion again must not
// allocate, though other niches are born and die in it, for the random streams go on.
template <typename PoseAt>
void expectNoAllocation(PairTracker& tracker, PoseAt&& pose_at, int cycles, int rounds) {
  PairSolution solution;
  double time = 0.0;
  for (int round = 0; round < rounds; ++round) {
    for (int k = 0; k < cycles; ++k) {
      tracker.update(pose_at(k), time += 0.01, solution);
    }
  }
  const std::size_t before = allocations.load();
  for (int k = 0; k < cycles; ++k) {
    tracker.update(pose_at(k), time += 0.01, solution);
    ASSERT_EQ(allocations.load() - before, 0U) << "cycle " << k;
  }
}

TEST(TrackerAllocation, AWarmCycleOfTheBatteryAllocatesNothing) {
  ASSERT_GT(allocations.load(), 0U) << "the counter is not in place";
  const std::vector<Eigen::Isometry3d> manoeuvre = test::readThesisPoses("manoeuvre_200.csv");
  for (const AccuracyLevel level : {AccuracyLevel::Certified, AccuracyLevel::Refined, AccuracyLevel::Nodes}) {
    TrackerParameters parameters;
    parameters.accuracy = level;
    PairTracker tracker("battery", test::loadThesisBody("fixture", 0.1), test::loadThesisBody("battery", 0.1),
                        parameters);
    // There and back, so that no step is a leap.
    const int count = static_cast<int>(manoeuvre.size());
    expectNoAllocation(
        tracker,
        [&](int k) { return manoeuvre[static_cast<std::size_t>(k < count ? k : 2 * count - 1 - k)]; },
        2 * count, 3);
  }
}

// Two combs, the teeth of one swaying in the other's gaps, or beside that by `shift`. With `cut_every`,
// cycles of that period are ended at their first look at the limit, which is what a time budget does at
// moments that the machine decides.
void expectNoAllocationOfCombs(TrackerParameters parameters, int cut_every = 0,
                               const Eigen::Vector3d& shift = Eigen::Vector3d::Zero()) {
  const auto comb = std::make_shared<BodyMesh>("comb", test::makeComb(5), BodyMeshOptions());
  std::atomic<bool> stop{false};
  if (cut_every > 0) parameters.stop = &stop;
  PairTracker tracker("combs", comb, comb, parameters);
  expectNoAllocation(
      tracker,
      [&](int k) {
        stop = cut_every > 0 && k % cut_every == 0;
        const double t = 2.0 * 3.14159265358979323846 * k / 200.0;
        Eigen::Isometry3d pose(
            Eigen::AngleAxisd(3.14159265358979323846 + 0.01 * std::sin(t), Eigen::Vector3d::UnitZ()));
        pose.translation() =
            Eigen::Vector3d(1.225 + 0.008 * std::sin(2.0 * t), 0.6 + 0.1 * std::sin(t), 0.02 * std::sin(t));
        pose.translation() += shift;
        return pose;
      },
      200, 3);
}

TEST(TrackerAllocation, AWarmCycleOfManyNichesAllocatesNothing) {
  expectNoAllocationOfCombs(TrackerParameters());
}

TEST(TrackerAllocation, AProvenCycleAllocatesNothingWithAndWithoutNiches) {
  TrackerParameters parameters;
  parameters.accuracy = AccuracyLevel::Certified;
  expectNoAllocationOfCombs(parameters);
  parameters.niches_wanted = false;
  expectNoAllocationOfCombs(parameters);
  // A budget, here one that is never used up, makes the proof go by another order.
  parameters.time_budget = 1e6;
  expectNoAllocationOfCombs(parameters);
}

// The proof after a cut one begins at the roots again, which takes more room than to go on from the last.
TEST(TrackerAllocation, ACycleAfterOneThatWasCutAllocatesNothing) {
  for (const bool niches_wanted : {true, false}) {
    TrackerParameters parameters;
    parameters.niches_wanted = niches_wanted;
    parameters.time_budget = 1e6;
    expectNoAllocationOfCombs(parameters, 4);
  }
}

TEST(TrackerAllocation, ACycleWithTeethInTeethOrFarAwayAllocatesNothing) {
  for (const bool niches_wanted : {true, false}) {
    TrackerParameters parameters;
    parameters.niches_wanted = niches_wanted;
    expectNoAllocationOfCombs(parameters, 0, {-0.3, 0.0, 0.0});
    expectNoAllocationOfCombs(parameters, 0, {1e4, 0.0, 0.0});
  }
}

TEST(EffectsAllocation, AWarmCycleInContactAllocatesNothing) {
  test::EffectScene scene(test::body("ground", makeBox({2, 2, 0.2})), test::body("feet", test::twoFeet()),
                          test::spring(1e4, FrictionModel::Bristle));
  const auto pose = [](int k) { return test::at(1e-5 * k, 0.0, 0.199); };
  for (int k = 0; k < 30; ++k) scene.update(pose(k));
  ASSERT_EQ(scene.contacts.regions.size(), 2U);
  scene.tracker.update(pose(30), 10.0, scene.solution);
  const std::size_t before = allocations.load();
  scene.effects.update(scene.solution, {}, 0.01, scene.contacts);
  EXPECT_EQ(allocations.load(), before);
}

TEST(SceneTrackerAllocation, AWarmCycleOfAllPairsAllocatesNothing) {
  const Scene scene = threeBoxes();
  SceneTracker tracker({1, nullptr});
  tracker.setScene(scene);
  std::vector<std::optional<Eigen::Isometry3d>> poses(3, Eigen::Isometry3d::Identity());
  poses[2]->translation().x() = -3.0;
  // Without an end, with one that is not reached, and with niches put off in every other cycle.
  for (const int mode : {0, 1, 2}) {
    const auto move = [&](int cycle) {
      using Clock = WorkLimit::Clock;
      poses[1]->translation() = Eigen::Vector3d(2.0, 0.3 * std::sin(0.05 * cycle), 0.0);
      Clock::time_point end = mode == 0 ? kNoCycleEnd : Clock::now() + std::chrono::hours(1);
      if (mode == 2 && cycle % 2 == 0) end = Clock::now();
      tracker.update(poses, 0.01 * cycle, {true, true, true, false}, end);
    };
    for (int cycle = 0; cycle < 1000; ++cycle) move(cycle);
    const std::size_t before = allocations.load();
    for (int cycle = 1000; cycle < 1100; ++cycle) move(cycle);
    EXPECT_EQ(allocations.load() - before, 0U) << "mode " << mode;
  }
}

}  // namespace
}  // namespace concave_distance::tracker_allocation_test
