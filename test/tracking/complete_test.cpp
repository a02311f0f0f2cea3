// Level `certified`: every niche there is, in every cycle, with identities that persist.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "concave_distance/tracking/pair_tracker.h"
#include "distance/niches/local_minima.h"
#include "support/body_pairs.h"
#include "support/enumeration.h"
#include "support/thesis_scenes.h"

namespace concave_distance::complete_test {
namespace {

using Body = std::shared_ptr<const BodyMesh>;
using Eigen::Isometry3d;
using Eigen::Vector3d;

TrackerParameters complete(bool hidden = true) {
  TrackerParameters parameters;
  parameters.hidden = hidden;
  parameters.largest_niche_count = 1000;
  return parameters;
}

using test::fiveTeeth;

Isometry3d swaying(double t) {
  return test::swayingComb(t, 0.004, 0.7, 0.15);
}

void expectEveryNiche(const Body& a, const Body& b, const Isometry3d& pose, const PairSolution& solution,
                      const TrackerParameters& parameters) {
  LocalMinimaRequest request;
  request.cutoff = parameters.cutoff;
  request.hidden = parameters.hidden;
  const LocalMinima truth = findLocalMinima(*a, *b, pose, request);
  ASSERT_EQ(solution.niches.size(), truth.niches.size());
  for (std::size_t i = 0; i < truth.niches.size(); ++i) {
    EXPECT_NEAR(solution.niches[i].distance, truth.niches[i].distance, 1e-12);
    EXPECT_EQ(solution.niches[i].outward, truth.niches[i].outward);
    EXPECT_EQ(solution.niches[i].visible, truth.niches[i].visible);
    EXPECT_EQ(solution.niches[i].kind, truth.niches[i].kind);
    EXPECT_TRUE(solution.niches[i].proven_local_minimum);
  }
}

// Where the proof says that all of a pair is beyond the cutoff there is no niche to search for.
TEST(Complete, NothingIsSearchedForBeyondTheCutoff) {
  TrackerParameters parameters = complete();
  parameters.cutoff = 0.001;
  PairTracker tracker("combs", fiveTeeth(), fiveTeeth(), parameters);
  PairSolution solution;
  std::uint64_t evaluations = 0;
  for (int i = 0; i < 300; ++i) {
    tracker.update(swaying(0.01 * i), 0.01 * i, solution);
    ASSERT_GT(solution.lower_bound, parameters.cutoff);
    EXPECT_TRUE(solution.niches.empty());
    evaluations += solution.cost.evaluations;
  }
  EXPECT_LT(evaluations, 10000U);  // of the sweep alone; the search took twice as many besides
}

class CompleteList : public testing::TestWithParam<bool> {};

TEST_P(CompleteList, HasEveryNicheAlongAMotionAndKeepsTheBooksOfTheirIds) {
  TrackerParameters parameters = complete(GetParam());
  parameters.cutoff = 0.3;
  PairTracker tracker("combs", fiveTeeth(), fiveTeeth(), parameters);
  PairSolution solution;
  std::set<std::uint64_t> alive;
  std::set<std::uint64_t> dead;
  for (int k = 0; k < 100; ++k) {
    SCOPED_TRACE("instant " + std::to_string(k));
    const Isometry3d pose = swaying(0.01 * k);
    tracker.update(pose, 0.01 * k, solution);
    EXPECT_EQ(solution.status, SolveStatus::Ok);
    EXPECT_EQ(solution.accuracy, AccuracyLevel::Certified);
    EXPECT_TRUE(solution.niches_complete);
    expectEveryNiche(fiveTeeth(), fiveTeeth(), pose, solution, parameters);
    for (const NicheEvent& event : solution.events) {
      if (event.kind == NicheEvent::Kind::Birth) {
        EXPECT_TRUE(alive.insert(event.id).second);
        EXPECT_EQ(dead.count(event.id), 0U) << "an id came back";
      } else {
        EXPECT_EQ(alive.erase(event.id), 1U);
        dead.insert(event.id);
      }
    }
    std::set<std::uint64_t> listed;
    for (const TrackedNiche& niche : solution.niches) listed.insert(niche.id);
    EXPECT_EQ(listed, alive);
    const double exact =
        std::sqrt(test::enumerateTrianglePairs(*fiveTeeth(), *fiveTeeth(), pose).squared_distance);
    EXPECT_NEAR(solution.distance, exact, 1e-13);
    EXPECT_LE(solution.lower_bound, exact);
    EXPECT_GE(solution.lower_bound, exact - 1e-12);
  }
  EXPECT_LE(alive.size() + dead.size(), 60U) << "niches in small motions are not new every time";
}
INSTANTIATE_TEST_SUITE_P(HiddenOrNot, CompleteList, testing::Bool());

TEST(CompleteListOf, KeepsEveryIdOfNichesThatLiveOn) {
  // The battery is lowered by a millimetre in forty steps: its nine niches are the same all the way.
  const test::ThesisScene s = test::loadThesisScene("battery_static", 0.5);
  PairTracker tracker("battery", s.a, s.b, complete());
  PairSolution solution;
  tracker.update(s.a_from_b, 0.0, solution);
  ASSERT_EQ(solution.niches.size(), 9U);
  EXPECT_EQ(solution.events.size(), 9U);
  std::vector<std::uint64_t> ids;
  for (const TrackedNiche& niche : solution.niches) ids.push_back(niche.id);
  for (int k = 1; k <= 40; ++k) {
    Isometry3d pose = s.a_from_b;
    pose.translation().z() -= 2.5e-5 * k;
    tracker.update(pose, 0.1 * k, solution);
    ASSERT_EQ(solution.niches.size(), 9U);
    EXPECT_TRUE(solution.events.empty());
    for (std::size_t i = 0; i < ids.size(); ++i) {
      EXPECT_EQ(solution.niches[i].id, ids[i]);
      EXPECT_LE(std::abs(solution.niches[i].closing_speed), 2.5e-4 * (1.0 + 1e-6));
    }
  }
  // At rest nothing is looked for, and nothing changes.
  Isometry3d pose = s.a_from_b;
  pose.translation().z() -= 1e-3;
  tracker.update(pose, 5.0, solution);
  ASSERT_EQ(solution.niches.size(), 9U);
  EXPECT_TRUE(solution.events.empty());
  EXPECT_EQ(solution.niches.front().closing_speed, 0.0);
}

TEST(CompleteListOf, SaysPenetratingWhereBodiesMeetOrSwallowEachOther) {
  const Body big = test::makeBody(test::makeCuboid(Vector3d(-1, -1, -1), Vector3d(1, 1, 1)));
  const Body small = test::makeBody(test::makeCuboid(Vector3d(-0.1, -0.1, -0.1), Vector3d(0.1, 0.1, 0.1)));
  const PairSolution meeting =
      solveOnce("pair", big, small, complete(), test::translation(Vector3d(1, 0, 0)));
  EXPECT_EQ(meeting.status, SolveStatus::Penetrating);
  EXPECT_EQ(meeting.distance, 0.0);
  ASSERT_FALSE(meeting.niches.empty());
  EXPECT_EQ(meeting.niches.front().distance, 0.0);
  const PairSolution inside =
      solveOnce("pair", big, small, complete(), test::translation(Vector3d(0.5, 0, 0)));
  EXPECT_EQ(inside.status, SolveStatus::Penetrating);
  EXPECT_NEAR(inside.surface_distance, 0.4, 1e-12);
  EXPECT_TRUE(inside.niches.empty());
}

TEST(CompleteListOf, ReportsACut) {
  TrackerParameters parameters = complete();
  parameters.largest_niche_count = 3;
  PairTracker tracker("combs", fiveTeeth(), fiveTeeth(), parameters);
  PairSolution solution;
  for (int k = 0; k < 3; ++k) {
    tracker.update(swaying(0.0), 0.1 * k, solution);
    EXPECT_EQ(solution.niches.size(), 3U);
    EXPECT_TRUE(solution.niches_cut);
  }
}

// Niches are asked for in one cycle of five, as between the logged times of a simulation.
TEST(CompleteListOf, GoesOnWithItsIdsAfterCyclesThatDidNotWantIt) {
  TrackerParameters wanted = complete(false);
  wanted.cutoff = 0.3;
  TrackerParameters distance_alone = wanted;
  distance_alone.niches_wanted = false;
  PairTracker tracker("combs", fiveTeeth(), fiveTeeth(), wanted);
  PairTracker always("combs", fiveTeeth(), fiveTeeth(), wanted);
  PairSolution solution;
  PairSolution reference;
  std::set<std::uint64_t> at_first;
  for (int k = 0; k <= 40; ++k) {
    SCOPED_TRACE("instant " + std::to_string(k));
    const bool is_wanted = k % 5 == 0;
    tracker.setParameters(is_wanted ? wanted : distance_alone);
    tracker.update(swaying(0.002 * k), 0.002 * k, solution);
    always.update(swaying(0.002 * k), 0.002 * k, reference);
    EXPECT_EQ(solution.distance, reference.distance);
    EXPECT_EQ(solution.niches_complete, is_wanted);
    if (!is_wanted) {
      EXPECT_TRUE(solution.niches.empty());
      continue;
    }
    expectEveryNiche(fiveTeeth(), fiveTeeth(), swaying(0.002 * k), solution, wanted);
    if (k == 0) {
      for (const TrackedNiche& niche : solution.niches) at_first.insert(niche.id);
    }
  }
  std::size_t kept = 0;
  for (const TrackedNiche& niche : solution.niches) {
    kept += at_first.count(niche.id);
    EXPECT_TRUE(std::isfinite(niche.closing_speed));
  }
  EXPECT_EQ(kept, at_first.size());
}

}  // namespace
}  // namespace concave_distance::complete_test
