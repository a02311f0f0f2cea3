#include <gtest/gtest.h>

#include <cmath>

#include "concave_distance/tracking/pair_tracker.h"
#include "support/body_pairs.h"
#include "support/mesh_variants.h"
#include "support/plain_shapes.h"

// Nearly convex bodies have one niche, and the distance's proof is the proof of their list.

namespace concave_distance::convex_pairs_test {
namespace {

using namespace test;
using Eigen::Isometry3d;
using Eigen::Vector3d;

SurfaceMesh cube(double half) {
  return halvedEdges(makeCuboid(Vector3d::Constant(-half), Vector3d::Constant(half)));
}

/// A cube with the middle of its upper face pushed in.
SurfaceMesh dentedCube(double depth) {
  return withVertices(cube(0.5), "dented", [&](const Vector3d& v) {
    return v.x() == 0.0 && v.y() == 0.0 && v.z() > 0.0 ? Vector3d(0.0, 0.0, 0.5 - depth) : v;
  });
}

Isometry3d at(const Vector3d& place, double turn) {
  Isometry3d pose = Isometry3d::Identity();
  pose.translation() = place;
  pose.linear() = Eigen::AngleAxisd(turn, Vector3d(1.0, 0.5, 0.2).normalized()).matrix();
  return pose;
}

bool wasLookedFor(const PairSolution& solution) {
  return solution.cost.evaluations > 0 || solution.cost.generations > 0;
}

TEST(ConvexPairs, HaveOneNicheThatNothingIsSearchedFor) {
  PairTracker tracker("cubes", makeBody(cube(0.5)), makeBody(cube(0.3)), {});
  PairSolution solution;
  std::uint64_t id = 0;
  for (int k = 0; k < 50; ++k) {
    tracker.update(at({0.9 + 0.2 * std::sin(0.3 * k), 0.1 * k - 2.0, 0.4}, 0.1 * k), 0.01 * k, solution);
    ASSERT_EQ(solution.niches.size(), 1U) << "cycle " << k;
    if (k == 0) id = solution.niches.front().id;
    EXPECT_EQ(solution.niches.front().id, id);
    EXPECT_EQ(solution.niches.front().distance, solution.distance);
    EXPECT_TRUE(std::isinf(solution.niches.front().prominence));
    EXPECT_TRUE(solution.niches_complete);
    EXPECT_FALSE(wasLookedFor(solution)) << "cycle " << k;
  }
}

TEST(ConvexPairs, ThatOverlapHaveOneNicheHoweverOftenTheirSurfacesMeet) {
  const auto rod = makeBody(makeCuboid({-1.0, -0.1, -0.1}, {1.0, 0.1, 0.1}));
  const auto plate = makeBody(makeCuboid({-0.05, -0.7, -0.7}, {0.05, 0.7, 0.7}));
  PairTracker tracker("rod through plate", rod, plate, {});
  PairSolution solution;
  for (int k = 0; k < 10; ++k) {
    tracker.update(at({0.02 * k, 0.01 * k, 0.0}, 0.02 * k), 0.01 * k, solution);
    EXPECT_EQ(solution.status, SolveStatus::Penetrating);
    ASSERT_EQ(solution.niches.size(), 1U) << "cycle " << k;
    EXPECT_EQ(solution.niches.front().distance, 0.0);
    EXPECT_EQ(solution.niches.front().id, 1U);
    EXPECT_TRUE(solution.niches_complete);
    EXPECT_FALSE(wasLookedFor(solution));
  }
}

TEST(ConvexPairs, OfWhichOneHoldsTheOtherHaveNoNiche) {
  PairTracker tracker("cube in a cube", makeBody(cube(0.5)), makeBody(cube(0.2)), {});
  PairSolution solution;
  tracker.update(at({0.1, 0.0, 0.0}, 0.3), 0.0, solution);
  EXPECT_EQ(solution.status, SolveStatus::Penetrating);
  EXPECT_TRUE(solution.niches.empty());
  EXPECT_TRUE(solution.niches_complete);
}

TEST(ConvexPairs, AreSearchedWhereADentMayHoldASecondNicheAndKeepTheirIds) {
  constexpr double kDepth = 1e-3;
  PairTracker tracker("dented", makeBody(dentedCube(kDepth)), makeBody(cube(0.3)), {});
  PairSolution solution;
  int searched = 0;
  int known = 0;
  for (int k = 0; k <= 100; ++k) {
    const double gap = 0.35 + 0.34 * std::cos(0.1 * k);
    tracker.update(at({0.1, 0.05, 0.8 + gap}, 1e-3), 0.01 * k, solution);
    ASSERT_FALSE(solution.niches.empty());
    EXPECT_EQ(solution.niches.front().id, 1U) << "gap " << gap;
    EXPECT_TRUE(solution.niches_complete);
    if (gap < kDepth / 1e-2) {
      EXPECT_TRUE(wasLookedFor(solution)) << "gap " << gap;
      ++searched;
    } else if (gap > 4.0 * kDepth / 1e-2) {
      EXPECT_FALSE(wasLookedFor(solution)) << "gap " << gap;
      ++known;
    }
  }
  EXPECT_GT(searched, 20);
  EXPECT_GT(known, 10);
}

// Pairs of features of which neither is beside a dent are left out: the list is the same as that of all
// cones, which a request for hidden niches goes through, and takes a fraction of the comparisons.
TEST(ConvexPairs, WithDentsThatAreAwayAreLookedThroughBesideThemAlone) {
  const auto a = makeBody(makeDentedEllipsoid({0.4, 0.3, 0.5}, 2e-3, 5e-3, 149));
  const auto b = makeBody(makeDentedEllipsoid({0.3, 0.3, 0.2}, 2e-3, 5e-3, 149));
  TrackerParameters usual;
  usual.search_share = 0.0;  // evaluations are comparisons of cones then
  TrackerParameters all = usual;
  all.hidden = true;
  PairTracker tracker("dents", a, b, usual);
  PairTracker of_all_cones("all cones", a, b, all);
  PairSolution solution;
  PairSolution expected;
  std::uint64_t evaluations = 0;
  std::uint64_t expected_evaluations = 0;
  for (int k = 0; k < 60; ++k) {
    const Isometry3d pose = at({0.75 + 0.02 * std::sin(0.2 * k), 0.1, 0.1}, 0.05 * k);
    tracker.update(pose, 0.01 * k, solution);
    of_all_cones.update(pose, 0.01 * k, expected);
    ASSERT_EQ(solution.status, SolveStatus::Ok);
    ASSERT_TRUE(solution.niches_complete);
    std::vector<double> visible;
    for (const TrackedNiche& niche : expected.niches) {
      if (niche.visible) visible.push_back(niche.distance);
    }
    ASSERT_EQ(solution.niches.size(), visible.size()) << "cycle " << k;
    for (std::size_t i = 0; i < visible.size(); ++i) {
      EXPECT_NEAR(solution.niches[i].distance, visible[i], 1e-12) << "cycle " << k;
    }
    evaluations += solution.cost.evaluations;
    expected_evaluations += expected.cost.evaluations;
  }
  EXPECT_LT(2 * evaluations, expected_evaluations);
}

TEST(ConvexPairs, AreSearchedWhereHiddenNichesOrThoseOfFarSidesAreWanted) {
  for (const bool hidden : {true, false}) {
    TrackerParameters parameters;
    parameters.hidden = hidden;
    parameters.keep_through_material = !hidden;
    PairTracker tracker("cubes", makeBody(cube(0.5)), makeBody(cube(0.3)), parameters);
    PairSolution solution;
    tracker.update(at({1.2, 0.1, 0.2}, 0.1), 0.0, solution);
    EXPECT_TRUE(wasLookedFor(solution));
    EXPECT_EQ(solution.niches.size(), hidden ? 1U : solution.niches.size());
  }
}

}  // namespace
}  // namespace concave_distance::convex_pairs_test
