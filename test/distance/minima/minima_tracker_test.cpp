#include "distance/minima/minima_tracker.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "base/constants.h"
#include "concave_distance/mesh/surface/primitives.h"
#include "distance/minima/front_checks.h"
#include "support/body_motions.h"
#include "support/body_pairs.h"

// Compares the front over a motion with all cones from the roots at every pose.

namespace concave_distance::detail::minima_tracker_test {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test::expectOneAncestor;
using test::expectWhatTheRootsFind;
using test::makeBody;
using test::Motion;
using test::placesOf;
using test::randomMotion;

using Body = std::shared_ptr<const BodyMesh>;

TEST(MinimaTracker, LeadsToTheMinimaThatTheRootsLeadToOverAnyMotion) {
  RandomEngine engine(11);
  for (std::uint32_t run = 0; run < 300; ++run) {
    const Body a = makeBody(test::concaveShape(run));
    const Body b = makeBody(test::concaveShape(run / 6));
    const Motion motion = randomMotion(engine);
    const double step = std::pow(10.0, -5.0 + 4.0 * uniformUnit(engine));
    const NormalSides sides = run % 3 == 0 ? NormalSides::Both : NormalSides::Outside;
    const double cutoff = run % 2 == 0 ? kInfinity : 0.7;
    SCOPED_TRACE("run " + std::to_string(run) + ", step " + std::to_string(step));
    MinimaTracker front;
    for (int k = 0; k < 60; ++k) {
      expectWhatTheRootsFind(a, b, motion.at(step * k), sides, cutoff, front);
      if (HasFailure()) return;
    }
  }
}

// Triangles of one sphere that lie in the other one are no surface; those around them have their cones by all
// neighbours.
TEST(MinimaTracker, LeadsToTheMinimaOfShellsThatCross) {
  RandomEngine engine(12);
  const SurfaceMesh sphere = makeSphere(0.6, 0.06);
  const Body spheres = makeBody(test::makeJoined(sphere, sphere, Vector3d(0.7, 0.3, 0.2)));
  ASSERT_FALSE(spheres->shellContacts().hidden.empty());
  for (std::uint32_t run = 0; run < 60; ++run) {
    const Body other = makeBody(test::concaveShape(run));
    const Motion motion = randomMotion(engine);
    const double step = std::pow(10.0, -3.0 + 2.0 * uniformUnit(engine));
    SCOPED_TRACE("run " + std::to_string(run) + ", step " + std::to_string(step));
    MinimaTracker front;
    for (int k = 0; k < 40; ++k) {
      const bool is_first = run % 2 == 0;
      expectWhatTheRootsFind(is_first ? spheres : other, is_first ? other : spheres, motion.at(step * k),
                             NormalSides::Outside, kInfinity, front);
      if (HasFailure()) return;
    }
  }
}

TEST(MinimaTracker, HasOneAncestorForEveryPairOfFeaturesAtEveryInstant) {
  RandomEngine engine(12);
  for (std::uint32_t run = 0; run < 12; ++run) {
    const Body a = makeBody(test::concaveShape(run % 4));
    const Body b = makeBody(test::concaveShape(run % 5));
    const Motion motion = randomMotion(engine);
    MinimaTracker front;
    for (int k = 0; k < 8; ++k) {
      std::vector<MinimumCandidate> candidates;
      WorkLimit none;
      const PairFrame frame = PairFrame::withFacets(*a, *b, motion.at(0.02 * k));
      front.collect(frame, NormalSides::Outside, kInfinity, candidates, none);
      expectOneAncestor(*a, *b, front);
      if (HasFailure()) return;
    }
  }
}

TEST(MinimaTracker, AsksNothingButLivePairsWhileTheBodiesStandStill) {
  const Body a = makeBody(test::concaveShape(0));
  const Body b = makeBody(test::concaveShape(3));
  const PairFrame frame = PairFrame::withFacets(*a, *b, test::translation(Vector3d(0.3, 0.2, 2.0)));
  MinimaTracker front;
  WorkLimit none;
  std::vector<MinimumCandidate> first;
  std::vector<MinimumCandidate> second;
  front.collect(frame, NormalSides::Outside, kInfinity, first, none);
  EXPECT_TRUE(front.counts().began_anew);
  EXPECT_GT(front.counts().kept, 0U);
  front.collect(frame, NormalSides::Outside, kInfinity, second, none);
  EXPECT_FALSE(front.counts().began_anew);
  EXPECT_EQ(front.counts().expired, 0U);
  EXPECT_EQ(front.counts().groups, 0U);
  EXPECT_EQ(front.counts().features, front.counts().live);
  EXPECT_EQ(placesOf(a, b, frame.a_from_b, first).size(), placesOf(a, b, frame.a_from_b, second).size());
}

TEST(MinimaTracker, GoesOnWhereALimitHasEndedIt) {
  RandomEngine engine(13);
  const Body a = makeBody(test::concaveShape(5));
  const Body b = makeBody(test::concaveShape(1));
  const Motion motion = randomMotion(engine);
  MinimaTracker front;
  const std::atomic<bool> stop{true};
  for (int k = 0; k < 40; ++k) {
    const Isometry3d pose = motion.at(0.01 * k);
    if (k % 4 == 1) {
      WorkLimit stopped(std::chrono::steady_clock::now(), kInfinity, std::numeric_limits<std::size_t>::max(),
                        &stop);
      std::vector<MinimumCandidate> candidates;
      const bool done = front.collect(PairFrame::withFacets(*a, *b, pose), NormalSides::Outside, kInfinity,
                                      candidates, stopped);
      EXPECT_FALSE(done && front.counts().expired > 0);
    } else {
      expectWhatTheRootsFind(a, b, pose, NormalSides::Outside, kInfinity, front);
    }
  }
}

TEST(MinimaTracker, BeginsAnewForAnotherCutoffAndOtherSides) {
  const Body a = makeBody(test::concaveShape(2));
  const Body b = makeBody(test::concaveShape(4));
  const Isometry3d pose = test::translation(Vector3d(0.1, 0.2, 1.5));
  MinimaTracker front;
  expectWhatTheRootsFind(a, b, pose, NormalSides::Outside, 0.1, front);
  expectWhatTheRootsFind(a, b, pose, NormalSides::Outside, kInfinity, front);
  EXPECT_TRUE(front.counts().began_anew);
  expectWhatTheRootsFind(a, b, pose, NormalSides::Both, kInfinity, front);
  EXPECT_TRUE(front.counts().began_anew);
}

}  // namespace
}  // namespace concave_distance::detail::minima_tracker_test
