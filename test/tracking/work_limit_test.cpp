// A time budget and the stop flag end every stage of a solve, and what is left is still an answer.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>

#include "base/constants.h"
#include "concave_distance/tracking/pair_effects.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "distance/niches/local_minima.h"
#include "support/body_pairs.h"
#include "support/enumeration.h"
#include "support/mesh_variants.h"

namespace concave_distance::work_limit_test {
namespace {

using Body = std::shared_ptr<const BodyMesh>;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kRounding = 1e-11;  // far above the kernel's at these sizes
constexpr AccuracyLevel kLevels[] = {AccuracyLevel::Nodes, AccuracyLevel::Refined, AccuracyLevel::Certified};

TrackerParameters parametersOf(AccuracyLevel level, double budget) {
  TrackerParameters parameters;
  parameters.accuracy = level;
  parameters.time_budget = budget;
  return parameters;
}

double exactDistance(const Body& a, const Body& b, const Isometry3d& pose) {
  return std::sqrt(test::enumerateTrianglePairs(*a, *b, pose).squared_distance);
}

// The bodies are apart at these poses, where the distance of the surfaces is the truth.
Isometry3d poseApart(RandomEngine& engine) {
  Isometry3d pose = Isometry3d::Identity();
  pose.linear() = test::randomRotation(engine);
  pose.translation() = 3.0 * test::randomRotation(engine).col(0);
  return pose;
}

void expectBracket(const PairSolution& solution, double exact) {
  ASSERT_FALSE(std::isnan(solution.distance)) << "there is always a distance";
  EXPECT_GE(solution.distance, exact - kRounding);
  EXPECT_TRUE(std::isnan(solution.lower_bound) || solution.lower_bound <= exact + kRounding);
  for (const TrackedNiche& niche : solution.niches) {
    EXPECT_NEAR((niche.point_b_in_a - niche.point_a_in_a).norm(), niche.distance, 1e-8);
    EXPECT_GE(niche.distance, exact - kRounding);
  }
}

TEST(WorkLimit, WithoutTimeEveryLevelGivesABracket) {
  RandomEngine engine(31);
  for (std::uint32_t shape = 0; shape < 6; ++shape) {
    const Body a = test::makeBody(test::concaveShape(shape), 0.1);
    const Body b = test::makeBody(test::concaveShape(shape + 1), 0.1);
    for (const AccuracyLevel level : kLevels) {
      for (const bool with_niches : {true, false}) {
        SCOPED_TRACE(std::string(toString(level)) + (with_niches ? " with niches " : " alone ") +
                     std::to_string(shape));
        const Isometry3d pose = poseApart(engine);
        TrackerParameters parameters = parametersOf(level, 1e-12);
        parameters.niches_wanted = with_niches;
        const PairSolution solution = solveOnce("pair", a, b, parameters, pose);
        expectBracket(solution, exactDistance(a, b, pose));
        EXPECT_TRUE(solution.status == SolveStatus::BudgetExhausted ||
                    (!with_niches && solution.status == SolveStatus::Ok));
        EXPECT_FALSE(solution.niches_complete);
      }
    }
  }
}

TEST(WorkLimit, TheStopFlagEndsASolveLikeABudget) {
  const Body a = test::makeBody(test::halvedEdges(test::halvedEdges(test::makeComb(5))), 0.05);
  Isometry3d pose(Eigen::AngleAxisd(0.3, Vector3d(1, 2, 2).normalized()));
  pose.translation() = Vector3d(1.0, 2.0, 1.5);
  const double exact = exactDistance(a, a, pose);
  std::atomic<bool> stop{true};
  for (const AccuracyLevel level : kLevels) {
    SCOPED_TRACE(toString(level));
    TrackerParameters parameters = parametersOf(level, kInfinity);
    parameters.stop = &stop;
    const PairSolution stopped = solveOnce("pair", a, a, parameters, pose);
    EXPECT_EQ(stopped.status, SolveStatus::BudgetExhausted);
    expectBracket(stopped, exact);
    stop = false;
    const PairSolution whole = solveOnce("pair", a, a, parameters, pose);
    EXPECT_EQ(whole.status, SolveStatus::Ok);
    EXPECT_LT(2 * stopped.cost.evaluations, whole.cost.evaluations);
    stop = true;
  }
}

// Cycles cut anywhere leave a state that the next one can go on from.
TEST(WorkLimit, AnyCutLeavesATrackerThatGoesOnRight) {
  RandomEngine engine(77);
  std::size_t cut = 0;
  for (std::uint32_t shape = 0; shape < 4; ++shape) {
    const Body a = test::makeBody(test::concaveShape(shape), 0.1);
    const Body b = test::makeBody(test::concaveShape(shape + 2), 0.1);
    for (const AccuracyLevel level : kLevels) {
      SCOPED_TRACE(std::string(toString(level)) + " " + std::to_string(shape));
      PairTracker tracker("pair", a, b, parametersOf(level, kInfinity));
      PairSolution solution;
      Isometry3d pose = poseApart(engine);
      for (int k = 0; k < 40; ++k) {
        const bool moves = uniformIndex(engine, 4) != 0;
        if (moves) pose.translation() += 0.02 * test::uniformInCube(engine, 1.0);
        if (uniformIndex(engine, 12) == 0) pose = poseApart(engine);
        const bool limited = uniformIndex(engine, 3) != 0;
        const double budget = limited ? std::pow(10.0, -6.5 + 4.0 * uniformUnit(engine)) : kInfinity;
        tracker.setParameters(parametersOf(level, budget));
        tracker.update(pose, 0.01 * k, solution);
        const double exact = exactDistance(a, b, pose);
        expectBracket(solution, exact);
        cut += solution.status == SolveStatus::BudgetExhausted ? 1 : 0;
        if (limited || !provesDistance(level)) continue;
        EXPECT_EQ(solution.status, SolveStatus::Ok);
        EXPECT_NEAR(solution.distance, exact, kRounding);
        EXPECT_EQ(solution.niches_complete, !solution.niches_cut);
        const PairSolution fresh = solveOnce("pair", a, b, parametersOf(level, kInfinity), pose);
        ASSERT_EQ(solution.niches.size(), fresh.niches.size());
        for (std::size_t i = 0; i < fresh.niches.size(); ++i) {
          EXPECT_NEAR(solution.niches[i].distance, fresh.niches[i].distance, kRounding);
        }
      }
    }
  }
  EXPECT_GT(cut, 50U) << "the budgets have to strike for this test to say anything";
}

// Shells apart are looked through whatever the distance; features and triangle pairs are not any more.
TEST(WorkLimit, TheWorkOfACompleteListDoesNotGrowWithTheDistance) {
  const SurfaceMesh comb = test::halvedEdges(test::halvedEdges(test::makeComb(5)));
  const Body a = test::makeBody(comb);
  LocalMinimaRequest request;
  for (const double distance : {30.0, 100.0, 300.0, 1e4, 1e7, 1e9}) {
    SCOPED_TRACE(distance);
    // Parallel to the axes, where most pairs of features are equally near.
    Isometry3d pose = Isometry3d::Identity();
    pose.translation() = Vector3d(0.0, distance, 0.0);
    const LocalMinima found = findLocalMinima(*a, *a, pose, request);
    ASSERT_FALSE(found.niches.empty());
    const double error = 1e-13 * distance;
    EXPECT_NEAR(found.niches.front().distance, exactDistance(a, a, pose), error);
    EXPECT_LT(found.cost.searched_pairs, 400'000U) << "of " << comb.triangleCount() * comb.triangleCount();
    if (distance < 250.0) continue;
    EXPECT_EQ(found.niches.size(), 1U) << "every pass is below the least prominence";
    EXPECT_EQ(found.cost.feature_pairs, 0U);
    EXPECT_LT(found.cost.searched_pairs, 10U);
  }
}

TEST(WorkLimit, ACutAnswerSaysThatItsRegionsAreMissing) {
  const Body a = test::makeBody(makeBox({1, 1, 1}));
  const Isometry3d pose = test::translation({0.9, 0.1, 0.2});
  const PairSolution solution = solveOnce("pair", a, a, TrackerParameters(), pose);
  ASSERT_EQ(solution.status, SolveStatus::Penetrating);
  EffectSettings settings;
  settings.interference = true;
  PairEffects effects(a, a, settings, ContactMaterial());
  PairContacts contacts;
  effects.update(solution, RelativeTwist(), 0.0, contacts);
  ASSERT_EQ(contacts.regions.size(), 1U);
  EXPECT_FALSE(contacts.cut);
  WorkLimit limit(WorkLimit::Clock::now(), 1e-12, std::numeric_limits<std::size_t>::max(), nullptr);
  effects.update(solution, RelativeTwist(), 0.0, contacts, &limit);
  EXPECT_TRUE(contacts.possible);
  EXPECT_TRUE(contacts.cut);
  EXPECT_TRUE(contacts.regions.empty());
}

}  // namespace
}  // namespace concave_distance::work_limit_test
