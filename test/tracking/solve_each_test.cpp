// Independent queries: by new trackers, by one that starts anew, and by many threads.
#include <gtest/gtest.h>

#include <utility>

#include "concave_distance/base/error.h"
#include "concave_distance/search/prepare_search.h"
#include "concave_distance/tracking/pair_effects.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "support/body_pairs.h"
#include "support/concave_shapes.h"
#include "support/solution_bytes.h"

namespace concave_distance::solve_each_test {
namespace {

test::Bytes bytesOf(const PairSolution& solution) {
  test::Bytes bytes;
  test::appendSolution(solution, bytes);
  return bytes;
}

/// Without the work: a first cycle of a tracker also keeps what the next one needs.
test::Bytes answerOf(PairSolution solution) {
  solution.cost = {};
  // A pose alone is not searched: its niches come from the cones.
  for (TrackedNiche& niche : solution.niches) niche.origin = NicheOrigin::Inherited;
  return bytesOf(solution);
}

class SolveEach : public ::testing::TestWithParam<AccuracyLevel> {
 protected:
  SolveEach() {
    parameters.accuracy = GetParam();
    for (int k = 0; k < 40; ++k) {
      Eigen::Isometry3d pose(Eigen::AngleAxisd(0.4 * k, Eigen::Vector3d(1, 2, 3).normalized()));
      pose.translation() = Eigen::Vector3d(0.1 * (k % 7) - 0.3, 0.2, 0.15 * (k % 11));
      poses.push_back(pose);
    }
  }
  PairSolution once(const Eigen::Isometry3d& pose) const {
    return solveOnce("pair", comb, rake, parameters, pose);
  }

  std::shared_ptr<const BodyMesh> comb = std::make_shared<BodyMesh>("comb", test::makeComb(4));
  std::shared_ptr<const BodyMesh> rake = std::make_shared<BodyMesh>("rake", test::makeComb(3));
  TrackerParameters parameters;
  std::vector<Eigen::Isometry3d> poses;
};

TEST_P(SolveEach, GivesTheAnswersOfSingleQueriesForAnyNumberOfThreads) {
  for (const bool niches : {true, false}) {
    parameters.niches_wanted = niches;
    for (const std::uint32_t threads : {0U, 1U, 3U}) {
      const std::vector<PairSolution> answers = solveEach("pair", comb, rake, parameters, poses, threads);
      ASSERT_EQ(answers.size(), poses.size());
      for (std::size_t i = 0; i < poses.size(); ++i) {
        ASSERT_EQ(bytesOf(answers[i]), bytesOf(once(poses[i]))) << i << ", niches " << niches;
      }
    }
  }
}

TEST_P(SolveEach, ATrackerSolvesPosesAloneAndThenStartsAnew) {
  PairTracker tracker("pair", comb, rake, parameters);
  PairTracker made_new("pair", comb, rake, parameters);
  PairSolution solution;
  PairSolution expected;
  tracker.update(poses[0], 0.0, solution);
  for (const Eigen::Isometry3d& pose : poses) {
    tracker.solve(pose, solution);
    PairTracker first("pair", comb, rake, parameters);
    first.update(pose, 0.0, expected);
    ASSERT_EQ(answerOf(solution), answerOf(expected));
  }
  for (int k = 0; k < 3; ++k) {
    tracker.update(poses[2], 0.01 * k, solution);
    made_new.update(poses[2], 0.01 * k, expected);
    ASSERT_EQ(bytesOf(solution), bytesOf(expected)) << k;
  }
}

TEST_P(SolveEach, ATrackerThatStartsAnewForgetsItsMotion) {
  PairTracker tracker("pair", comb, rake, parameters, 100);
  PairTracker made_new("pair", comb, rake, parameters, 100);
  PairSolution solution;
  for (std::size_t i = 0; i < poses.size(); ++i)
    tracker.update(poses[i], 0.1 * static_cast<double>(i), solution);
  tracker.restart();
  PairSolution expected;
  for (int k = 0; k < 20; ++k) {
    const Eigen::Isometry3d pose = Eigen::Translation3d(0.001 * k, 0.0, 0.0) * poses[5];
    tracker.update(pose, 0.01 * k, solution);
    made_new.update(pose, 0.01 * k, expected);
    ASSERT_EQ(bytesOf(solution), bytesOf(expected)) << k;
  }
}

TEST_P(SolveEach, APreparedTrackerAnswersAsAnotherOne) {
  PairTracker tracker("pair", comb, rake, parameters);
  tracker.prepare(poses);
  PairSolution solution;
  tracker.update(poses[3], 0.0, solution);
  EXPECT_EQ(answerOf(solution), answerOf(once(poses[3])));
}

INSTANTIATE_TEST_SUITE_P(EveryLevel, SolveEach,
                         ::testing::Values(AccuracyLevel::Nodes, AccuracyLevel::Refined,
                                           AccuracyLevel::Certified));

TEST(PairTrackerUse, PreparingMakesWhatASearchNeeds) {
  const auto comb = std::make_shared<BodyMesh>("comb", test::makeComb(4));
  PairTracker tracker("pair", comb, comb, TrackerParameters());
  EXPECT_EQ(searchPreparationOf(*comb).grid_nodes, 0U);
  tracker.prepare();
  EXPECT_GT(searchPreparationOf(*comb).grid_nodes, 0U);
  EXPECT_TRUE(searchPreparationOf(*comb).is_complete);
}

TEST(PairTrackerUse, BodiesThatAreMissingAreRefusedByName) {
  const auto comb = std::make_shared<BodyMesh>("comb", test::makeComb(4));
  const auto refusal = [](const auto& act) -> std::string {
    try {
      act();
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(refusal([&] { PairTracker("pair", nullptr, comb, TrackerParameters()); }).find("body A is null"),
            std::string::npos);
  EXPECT_NE(refusal([&] { PairTracker("pair", comb, nullptr, TrackerParameters()); }).find("body B is null"),
            std::string::npos);
  EXPECT_NE(refusal([&] { PairEffects(comb, nullptr, EffectSettings(), ContactMaterial()); }).find("body B"),
            std::string::npos);
  EXPECT_NE(refusal([&] { BodyMesh("empty", SurfaceMesh()); }).find("empty: "), std::string::npos);
}

TEST(PairTrackerUse, ATrackerThatWasMovedFromIsRefused) {
  const auto comb = std::make_shared<BodyMesh>("comb", test::makeComb(4));
  PairTracker tracker("pair", comb, comb, TrackerParameters());
  PairTracker other = std::move(tracker);
  PairSolution solution;
  // NOLINTNEXTLINE(bugprone-use-after-move)
  EXPECT_THROW(tracker.update(Eigen::Isometry3d::Identity(), 0.0, solution), Error);
  EXPECT_THROW(tracker.reset(), Error);
  other.update(Eigen::Isometry3d::Identity(), 0.0, solution);
  EXPECT_EQ(solution.status, SolveStatus::Penetrating);
  tracker = std::move(other);
  tracker.reset();
}

TEST(PairTrackerUse, WithoutNichesNoneIsListed) {
  const auto comb = std::make_shared<BodyMesh>("comb", test::makeComb(4));
  TrackerParameters parameters;
  parameters.niches_wanted = false;
  PairTracker tracker("pair", comb, comb, parameters);
  PairSolution solution;
  tracker.update(Eigen::Isometry3d(Eigen::Translation3d(0, 0, 5)), 0.0, solution);
  tracker.update(Eigen::Isometry3d(Eigen::Translation3d(0, 0, 4.9)), 0.1, solution);
  EXPECT_TRUE(solution.niches.empty());
  EXPECT_NEAR(solution.closing_speed, 1.0, 1e-9);
  EXPECT_NEAR(std::abs(solution.normal_in_a.z()), 1.0, 1e-9);
}

}  // namespace
}  // namespace concave_distance::solve_each_test
