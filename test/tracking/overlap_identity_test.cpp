#include <gtest/gtest.h>

#include <algorithm>

#include "concave_distance/tracking/pair_tracker.h"
#include "support/body_pairs.h"
#include "support/count_allocations.h"

// A niche at distance 0 is a part of the overlap, and goes on as long as that does.

namespace concave_distance::overlap_identity_test {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test::makeBody;
using test::translation;
using test::turned;
using Body = std::shared_ptr<const BodyMesh>;

Body plate() {
  return makeBody(test::makeExtrusion(
      {{-1.0, 0.0}, {1.0, 0.0}, {1.0, 0.1}, {0.9, 0.1}, {0.9, 0.3}, {0.8, 0.3}, {0.8, 0.1}, {-1.0, 0.1}},
      2.0));
}

/// A rod 0.1 m thick with a head: from its tip at y = -1 to y = 0.1.
Body rodWithHead() {
  return makeBody(test::makeExtrusion({{-0.05, -1.0},
                                       {0.05, -1.0},
                                       {0.05, 0.0},
                                       {0.2, 0.0},
                                       {0.2, 0.1},
                                       {-0.2, 0.1},
                                       {-0.2, 0.0},
                                       {-0.05, 0.0}},
                                      0.1));
}

std::vector<std::uint64_t> idsAtZero(const PairSolution& solution) {
  std::vector<std::uint64_t> ids;
  for (const TrackedNiche& niche : solution.niches) {
    if (niche.distance == 0.0) ids.push_back(niche.id);
  }
  return ids;
}

std::size_t countEvents(const PairSolution& solution, NicheEvent::Kind kind) {
  return static_cast<std::size_t>(std::count_if(solution.events.begin(), solution.events.end(),
                                                [&](const NicheEvent& e) { return e.kind == kind; }));
}

/// Moves B in by equal steps from the first to the last translation, turned a little.
template <typename Check>
void move(PairTracker& tracker, const Vector3d& from, const Vector3d& to, int steps, const Check& check) {
  PairSolution solution;
  for (int k = 0; k <= steps; ++k) {
    const double share = static_cast<double>(k) / steps;
    tracker.update(turned(0.1, {1.0, 0.2, 0.3}, from + share * (to - from)), 0.01 * k, solution);
    EXPECT_TRUE(solution.niches_complete) << "step " << k;
    check(k, solution);
  }
}

TEST(OverlapIdentity, OfARodThatGoesThroughAPlateAndBackIsKept) {
  const Body rod = rodWithHead();
  for (const int steps : {6, 40, 400}) {
    SCOPED_TRACE(std::to_string(steps) + " steps");
    PairTracker tracker("rod", plate(), rod, {});
    std::uint64_t id = 0;
    const auto expect_same = [&](int k, const PairSolution& solution) {
      const std::vector<std::uint64_t> ids = idsAtZero(solution);
      ASSERT_EQ(ids.size(), 1U) << "step " << k;
      if (id == 0) id = ids.front();
      EXPECT_EQ(ids.front(), id) << "step " << k;
    };
    // From where the end is in the plate to where it is far beyond, and back.
    move(tracker, {0.0, 1.05, 0.0}, {0.0, 0.5, 0.0}, steps, expect_same);
    move(tracker, {0.0, 0.5, 0.0}, {0.0, 1.05, 0.0}, steps, expect_same);
  }
}

TEST(OverlapIdentity, OfTheOldestIsKeptWherePartsBecomeOne) {
  const Body hook = makeBody(test::makeHook(0.8, 0.7));
  PairTracker tracker("hook", plate(), hook, {});
  std::vector<std::uint64_t> two;
  std::size_t merges = 0;
  move(tracker, {-0.5, -0.3, 0.0}, {-0.5, 0.05, 0.0}, 50, [&](int k, const PairSolution& solution) {
    const std::vector<std::uint64_t> ids = idsAtZero(solution);
    if (k == 0) two = ids;
    merges += countEvents(solution, NicheEvent::Kind::Merge);
    if (k == 0) {
      ASSERT_EQ(ids.size(), 2U);
    } else if (ids.size() == 1U) {
      EXPECT_EQ(ids.front(), *std::min_element(two.begin(), two.end())) << "step " << k;
    } else {
      EXPECT_EQ(ids, two) << "step " << k;
    }
    if (k == 50) {
      EXPECT_EQ(ids.size(), 1U);
    }
  });
  EXPECT_GE(merges, 1U);
}

TEST(OverlapIdentity, OfANicheGoesOnWhereTheBodiesBeginToOverlap) {
  PairTracker tracker("rod", plate(), rodWithHead(), {});
  std::uint64_t nearest = 0;
  move(tracker, {0.0, 1.2, 0.0}, {0.0, 0.5, 0.0}, 60, [&](int k, const PairSolution& solution) {
    ASSERT_FALSE(solution.niches.empty());
    if (k == 0) nearest = solution.niches.front().id;
    EXPECT_EQ(solution.niches.front().id, nearest) << "step " << k;
    EXPECT_LE(idsAtZero(solution).size(), 1U);
  });
}

TEST(OverlapIdentity, AreTheSameColdAndTracked) {
  const Body comb = makeBody(test::makeComb(4));
  const Body through = plate();
  PairTracker tracker("comb", through, comb, {});
  move(tracker, {-0.7, -0.2, 0.0}, {-0.6, 0.1, 0.1}, 40, [&](int k, const PairSolution& solution) {
    const PairSolution cold = solveOnce("comb", through, comb, {}, solution.a_from_b);
    ASSERT_EQ(cold.niches.size(), solution.niches.size()) << "step " << k;
    for (std::size_t i = 0; i < cold.niches.size(); ++i) {
      EXPECT_EQ(cold.niches[i].distance, solution.niches[i].distance) << "step " << k;
    }
  });
}

// At `refined` a search finds a place where the surfaces meet, and the parts are the same.
TEST(OverlapIdentity, IsThatOfAPartAtLevelRefined) {
  TrackerParameters parameters;
  parameters.accuracy = AccuracyLevel::Refined;
  const Body rod = makeBody(test::makeLShape(1.0, 0.1, 0.1));
  PairTracker tracker("rod", plate(), rod, parameters);
  PairSolution solution;
  std::uint64_t id = 0;
  for (int k = 0; k < 40; ++k) {
    tracker.update(turned(0.1, {1.0, 0.2, 0.3}, {0.0, -0.2 - 0.005 * k, 0.0}), 0.01 * k, solution);
    const std::vector<std::uint64_t> ids = idsAtZero(solution);
    ASSERT_EQ(ids.size(), 1U) << "step " << k;
    if (id == 0) id = ids.front();
    EXPECT_EQ(ids.front(), id) << "step " << k;
  }
}

TEST(OverlapIdentity, CostsNoMemoryInAWarmCycle) {
  const Body comb = makeBody(test::makeComb(4));
  PairTracker tracker("comb", plate(), comb, {});
  PairSolution solution;
  std::size_t allocated = 0;
  for (int round = 0; round < 3; ++round) {
    for (int k = 0; k < 60; ++k) {
      const double t = 2.0 * M_PI * k / 60.0;
      const Isometry3d pose =
          turned(0.1 * std::sin(t), {1.0, 0.2, 0.3}, {-0.7, -0.2 + 0.1 * std::cos(t), 0.05 * std::sin(t)});
      const std::size_t before = allocations.load();
      tracker.update(pose, 0.6 * round + 0.01 * k, solution);
      if (round == 2) allocated += allocations.load() - before;
    }
  }
  EXPECT_EQ(allocated, 0U);
}

}  // namespace
}  // namespace concave_distance::overlap_identity_test
