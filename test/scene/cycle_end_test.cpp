// A cycle with an end: every distance is proven, and lists that there is no time for are finished later.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <vector>

#include "concave_distance/scene/scene_tracker.h"
#include "support/box_scene.h"
#include "support/enumeration.h"
#include "support/random_solids.h"
#include "support/solution_bytes.h"

namespace concave_distance::cycle_end_test {
namespace {

using Clock = WorkLimit::Clock;
using Poses = std::vector<std::optional<Eigen::Isometry3d>>;
using Seconds = std::chrono::duration<double>;

constexpr double kRounding = 1e-11;  // far above the kernel's at these sizes
constexpr std::size_t kBalls = 6;

Clock::time_point in(double seconds) {
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(Seconds(seconds));
}

// Bumpy balls around a circle, some of which overlap at times: every pair has many niches.
Scene bumpyBalls() {
  const auto mesh =
      std::make_shared<const BodyMesh>("ball", test::makeBumpyBall(0.4, 1.5e-3, 9.0), BodyMeshOptions());
  Scene scene;
  for (std::size_t k = 0; k < kBalls; ++k) {
    SceneBody body = unitBox("ball " + std::to_string(k));
    body.mesh = mesh;
    body.bounds = boundsOf(mesh->surface());
    scene.bodies.push_back(body);
  }
  for (std::size_t a = 0; a < kBalls; ++a) {
    for (std::size_t b = a + 1; b < kBalls; ++b) {
      ScenePair pair;
      pair.name = std::to_string(a) + "/" + std::to_string(b);
      pair.body_a = a;
      pair.body_b = b;
      scene.pairs.push_back(pair);
    }
  }
  return scene;
}

Poses posesAt(int step) {
  Poses poses;
  for (std::size_t k = 0; k < kBalls; ++k) {
    const double angle = 6.28318530717958648 * static_cast<double>(k) / kBalls;
    const double turn = 0.002 * step * (k % 2 == 0 ? 1.0 : -0.6);
    Eigen::Isometry3d pose(Eigen::AngleAxisd(turn + angle, Eigen::Vector3d(1, 2, 2) / 3.0));
    pose.pretranslate((0.93 + 0.05 * std::sin(0.02 * step + angle)) *
                      Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0));
    poses.push_back(pose);
  }
  return poses;
}

Eigen::Isometry3d poseOf(const Poses& poses, const ScenePair& pair) {
  return poses[pair.body_a]->inverse() * *poses[pair.body_b];
}

PairSolution truthOf(const TrackedPair& pair, const Eigen::Isometry3d& pose) {
  TrackerParameters alone;
  alone.niches_wanted = false;
  return solveOnce("p", pair.body_a->mesh, pair.body_b->mesh, alone, pose);
}

double secondsOfCycle(SceneTracker& tracker, int step, const PairDemand& demand) {
  const Clock::time_point start = Clock::now();
  tracker.update(posesAt(step), 0.02 * step, demand);
  return Seconds(Clock::now() - start).count();
}

class CycleEnd : public ::testing::TestWithParam<std::uint32_t> {
 protected:
  CycleEnd() { tracker.setScene(scene); }

  void expectBracket(const TrackedPair& pair, double exact) {
    ASSERT_TRUE(pair.solved());
    const PairSolution& solution = pair.solution;
    EXPECT_GE(solution.distance, exact - kRounding);
    EXPECT_LE(solution.lower_bound, exact + kRounding);
    if (solution.status == SolveStatus::Ok) {
      EXPECT_NEAR(solution.distance, exact, kRounding);
      EXPECT_NEAR(solution.lower_bound, exact, kRounding);
    }
    for (const TrackedNiche& niche : solution.niches) {
      EXPECT_GE(niche.distance, exact - kRounding);
      EXPECT_NEAR((niche.point_b_in_a - niche.point_a_in_a).norm(), niche.distance, 1e-8);
    }
    EXPECT_EQ(pair.put_off, !solution.niches_complete) << "nothing else can have cut a list here";
  }

  Scene scene = bumpyBalls();
  SceneTracker tracker{{GetParam(), nullptr}};
};

TEST_P(CycleEnd, ThatIsNeverReachedChangesNoAnswer) {
  SceneTracker endless({1, nullptr});
  endless.setScene(scene);
  for (int step = 0; step < 6; ++step) {
    endless.update(posesAt(step), 0.02 * step);
    const CycleCounts counts = tracker.update(posesAt(step), 0.02 * step, {true, true, true, false}, in(1e6));
    EXPECT_EQ(counts.put_off, 0U);
    for (std::size_t index = 0; index < scene.pairs.size(); ++index) {
      const PairSolution& expected = endless.pairs()[index]->solution;
      const PairSolution& solution = tracker.pairs()[index]->solution;
      EXPECT_TRUE(solution.niches_complete);
      EXPECT_EQ(solution.distance, expected.distance);
      EXPECT_EQ(solution.point_a_in_a, expected.point_a_in_a);
      ASSERT_EQ(solution.niches.size(), expected.niches.size());
      for (std::size_t k = 0; k < expected.niches.size(); ++k) {
        EXPECT_EQ(solution.niches[k].id, expected.niches[k].id);
        EXPECT_EQ(solution.niches[k].distance, expected.niches[k].distance);
      }
    }
  }
}

TEST_P(CycleEnd, ThatHasPassedLeavesBracketsAndKnownNiches) {
  tracker.update(posesAt(0), 0.0);
  for (int step = 1; step < 4; ++step) {
    const Poses poses = posesAt(8 * step);
    const CycleCounts counts = tracker.update(poses, 0.02 * step, {true, true, true, false}, Clock::now());
    EXPECT_EQ(counts.put_off, scene.pairs.size());
    for (std::size_t index = 0; index < scene.pairs.size(); ++index) {
      const TrackedPair& pair = *tracker.pairs()[index];
      expectBracket(pair, truthOf(pair, poseOf(poses, scene.pairs[index])).distance);
      EXPECT_FALSE(pair.solution.niches.empty()) << "those of the first cycle, where their points are now";
      EXPECT_TRUE(pair.solution.events.empty());
    }
  }
  // With time again every list is whole, at the same input too.
  tracker.update(posesAt(24), 0.06);
  for (const auto& pair : tracker.pairs()) EXPECT_TRUE(pair->solution.niches_complete);
}

TEST_P(CycleEnd, LeavesProvenDistancesAndFinishesEachListInLaterCycles) {
  const PairDemand with_niches{true, true, true, false};
  SceneTracker whole({GetParam(), nullptr});
  whole.setScene(scene);
  const double proofs = secondsOfCycle(whole, 0, {true, true, false, false});
  const double niches = secondsOfCycle(whole, 0, with_niches);
  double warm = niches;
  for (int step = 1; step < 9; ++step) warm = std::min(warm, secondsOfCycle(whole, step, with_niches));
  // A small part of what the first lists take; so long that a busy machine seldom stands still for all of it.
  const double budget = 5e-3 + 2.0 * proofs + std::min(0.1 * niches, 0.7 * warm);
  std::vector<int> incomplete(scene.pairs.size(), 0);
  int longest = 0;
  int unproven = 0;
  std::uint64_t put_off = 0;
  constexpr int kCycles = 150;
  for (int step = 0; step < kCycles; ++step) {
    const Poses poses = posesAt(step);
    put_off += tracker.update(poses, 0.02 * step, with_niches, in(budget)).put_off;
    if (step % 10 == 0) whole.update(poses, 0.02 * step + 1.0);
    for (std::size_t index = 0; index < scene.pairs.size(); ++index) {
      const TrackedPair& pair = *tracker.pairs()[index];
      const Eigen::Isometry3d pose = poseOf(poses, scene.pairs[index]);
      const PairSolution truth = truthOf(pair, pose);
      expectBracket(pair, truth.distance);
      unproven += pair.solution.status == SolveStatus::BudgetExhausted ? 1 : 0;
      incomplete[index] = pair.solution.niches_complete ? 0 : incomplete[index] + 1;
      longest = std::max(longest, incomplete[index]);
      if (step % 50 == 0 && index == 0 && truth.status == SolveStatus::Ok) {
        EXPECT_NEAR(
            pair.solution.distance,
            std::sqrt(
                test::enumerateTrianglePairs(*pair.body_a->mesh, *pair.body_b->mesh, pose).squared_distance),
            kRounding);
      }
      if (step % 10 != 0 || !pair.solution.niches_complete) continue;
      const PairSolution& expected = whole.pairs()[index]->solution;
      ASSERT_EQ(pair.solution.niches.size(), expected.niches.size()) << "cycle " << step;
      for (std::size_t k = 0; k < expected.niches.size(); ++k) {
        EXPECT_NEAR(pair.solution.niches[k].distance, expected.niches[k].distance, kRounding);
      }
    }
    if (HasFailure()) return;
  }
  RecordProperty("longest", longest);
  std::printf(
      "budget %.1f ms (proofs %.1f, niches %.1f, warm %.1f), put off %llu of %d, longest wait %d, unproven "
      "%d\n",
      1e3 * budget, 1e3 * proofs, 1e3 * niches, 1e3 * warm, static_cast<unsigned long long>(put_off),
      kCycles * static_cast<int>(scene.pairs.size()), longest, unproven);
  EXPECT_GT(put_off, 0U) << "the end has to strike for this test to say anything";
  EXPECT_LE(unproven, kCycles * static_cast<int>(scene.pairs.size()) / 20)
      << "only where the machine stands still longer than a cycle";
  EXPECT_LE(longest, 60);
}

// A cold pair takes what is left: one thread reaches a list only when those before it are finished.
TEST_P(CycleEnd, FindsTheLastNichesAfterAllOthers) {
  if (GetParam() != 1) return;
  const Poses poses = posesAt(0);
  std::size_t nearest = 0;
  tracker.update(poses, 0.0, {true, true, false, false});
  for (std::size_t index = 1; index < scene.pairs.size(); ++index) {
    const auto distance = [&](std::size_t pair) { return tracker.pairs()[pair]->solution.distance; };
    if (distance(index) < distance(nearest)) nearest = index;
  }
  const double cold = secondsOfCycle(tracker, 0, {true, true, true, false});
  std::vector<PairDemand> demand(scene.pairs.size(), {true, true, true, false});
  demand[nearest].niches_last = true;  // it would come first
  const auto demand_of = [&](std::size_t index, const TrackedPair&) { return demand[index]; };
  std::size_t put_off = 0;
  for (const double share : {0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 5.0}) {
    SceneTracker fresh({1, nullptr});
    fresh.setScene(scene);
    put_off += fresh.update(poses, 0.0, demand_of, in(share * cold)).put_off;
    if (fresh.pairs()[nearest]->solution.niches.empty()) continue;
    for (std::size_t index = 0; index < scene.pairs.size(); ++index) {
      EXPECT_TRUE(index == nearest || !fresh.pairs()[index]->put_off) << scene.pairs[index].name;
    }
  }
  EXPECT_GT(put_off, 0U) << "the end has to strike for this test to say anything";
}

INSTANTIATE_TEST_SUITE_P(Threads, CycleEnd, ::testing::Values(1U, 2U));

}  // namespace
}  // namespace concave_distance::cycle_end_test
