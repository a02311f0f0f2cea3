#include "distance/cone_front.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>

#include "concave_distance/mesh/surface/primitives.h"
#include "distance/minima_candidates.h"
#include "distance/witness_refinement.h"
#include "support/body_motions.h"
#include "support/body_pairs.h"

// What the front keeps over a motion against all cones from the roots at every pose.

namespace concave_distance::detail {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test::makeBody;
using test::Motion;
using test::randomMotion;

using Body = std::shared_ptr<const BodyMesh>;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<WitnessPair> placesOf(const Body& a, const Body& b, const Isometry3d& pose,
                                  const std::vector<MinimumSeed>& seeds) {
  RefinementWorkspace workspace;
  std::vector<WitnessPair> places;
  for (const MinimumSeed& seed : seeds) {
    places.push_back(refineWitness(*a, *b, pose, seed.a, seed.b, workspace).witness);
  }
  return places;
}

/// A place is known where the other list has one with the same distance whose points are near: two pairs of
/// features of one plateau hold the same minimum.
bool isKnown(const WitnessPair& place, const std::vector<WitnessPair>& others) {
  return std::any_of(others.begin(), others.end(), [&](const WitnessPair& other) {
    return std::abs(std::sqrt(place.squared_distance) - std::sqrt(other.squared_distance)) < 1e-12 &&
           (place.point_a_in_a - other.point_a_in_a).norm() +
                   (place.point_b_in_a - other.point_b_in_a).norm() <
               1e-9;
  });
}

void expectWhatTheRootsFind(const Body& a, const Body& b, const Isometry3d& pose, NormalSides sides,
                            double cutoff, ConeFront& front) {
  WorkLimit none;
  const MinimaScene scene(*a, *b, pose);
  std::vector<MinimumSeed> from_roots;
  LocalMinimaCost cost;
  collectConeSeeds(scene, sides, cutoff, from_roots, cost, none);
  std::vector<MinimumSeed> from_front;
  ASSERT_TRUE(front.collect(scene, sides, cutoff, from_front, none));
  const auto of_front = placesOf(a, b, pose, from_front);
  for (const WitnessPair& place : placesOf(a, b, pose, from_roots)) {
    EXPECT_TRUE(isKnown(place, of_front)) << "distance " << std::sqrt(place.squared_distance);
  }
  // What was a minimum at an earlier pose and is only measured at this one.
  std::vector<WitnessPair> seeds;
  for (const MinimumSeed& seed : from_roots) seeds.push_back(scene.witnessOf(seed));
  for (const MinimumSeed& seed : from_front) {
    EXPECT_TRUE(isKnown(scene.witnessOf(seed), seeds)) << "distance " << seed.distance;
  }
}

TEST(ConeFront, LeadsToTheMinimaThatTheRootsLeadToOverAnyMotion) {
  RandomEngine engine(11);
  for (std::uint32_t run = 0; run < 300; ++run) {
    const Body a = makeBody(test::concaveShape(run));
    const Body b = makeBody(test::concaveShape(run / 6));
    const Motion motion = randomMotion(engine);
    const double step = std::pow(10.0, -5.0 + 4.0 * uniformUnit(engine));
    const NormalSides sides = run % 3 == 0 ? NormalSides::Both : NormalSides::Outside;
    const double cutoff = run % 2 == 0 ? kInfinity : 0.7;
    SCOPED_TRACE("run " + std::to_string(run) + ", step " + std::to_string(step));
    ConeFront front;
    for (int k = 0; k < 60; ++k) {
      expectWhatTheRootsFind(a, b, motion.at(step * k), sides, cutoff, front);
      if (HasFailure()) return;
    }
  }
}

// Triangles of one sphere that lie in the other one are no surface; those around them have their cones by all
// neighbours.
TEST(ConeFront, LeadsToTheMinimaOfShellsThatCross) {
  RandomEngine engine(12);
  const SurfaceMesh sphere = makeSphere(0.6, 0.06);
  const Body spheres = makeBody(test::makeUnion(sphere, sphere, Vector3d(0.7, 0.3, 0.2)));
  ASSERT_FALSE(spheres->joints().hidden.empty());
  for (std::uint32_t run = 0; run < 60; ++run) {
    const Body other = makeBody(test::concaveShape(run));
    const Motion motion = randomMotion(engine);
    const double step = std::pow(10.0, -3.0 + 2.0 * uniformUnit(engine));
    SCOPED_TRACE("run " + std::to_string(run) + ", step " + std::to_string(step));
    ConeFront front;
    for (int k = 0; k < 40; ++k) {
      const bool is_first = run % 2 == 0;
      expectWhatTheRootsFind(is_first ? spheres : other, is_first ? other : spheres, motion.at(step * k),
                             NormalSides::Outside, kInfinity, front);
      if (HasFailure()) return;
    }
  }
}

/// How many pairs of the front lie above a pair of items, for every pair.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> ancestorCounts(const NormalConeTree& a,
                                                                      const NormalConeTree& b,
                                                                      const ConeFront& front) {
  const auto items_below = [](const NormalConeTree& tree, NormalConeTree::Slot slot) {
    std::vector<std::uint32_t> items;
    std::vector<NormalConeTree::Slot> open{slot};
    while (!open.empty()) {
      const std::uint32_t child = tree.child(open.back());
      open.pop_back();
      if (child == NormalConeTree::kNoChild) continue;
      if (ConeComparison::isItem(child)) {
        items.push_back(child & ~NormalConeTree::kItemFlag);
        continue;
      }
      for (std::uint32_t part = child; part < child + NormalConeTree::kWidth; ++part) open.push_back(part);
    }
    return items;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> counts;
  front.forEachPair([&](NormalConeTree::Slot slot_a, NormalConeTree::Slot slot_b) {
    for (const std::uint32_t i : items_below(a, slot_a)) {
      for (const std::uint32_t k : items_below(b, slot_b)) ++counts[{i, k}];
    }
  });
  return counts;
}

TEST(ConeFront, HasOneAncestorForEveryPairOfFeaturesAtEveryInstant) {
  RandomEngine engine(12);
  for (std::uint32_t run = 0; run < 12; ++run) {
    const Body a = makeBody(test::concaveShape(run % 4));
    const Body b = makeBody(test::concaveShape(run % 5));
    const NormalConeTree& cones_a = a->normalCones(NormalSides::Outside);
    const NormalConeTree& cones_b = b->normalCones(NormalSides::Outside);
    const Motion motion = randomMotion(engine);
    ConeFront front;
    for (int k = 0; k < 8; ++k) {
      std::vector<MinimumSeed> seeds;
      WorkLimit none;
      const MinimaScene scene(*a, *b, motion.at(0.02 * k));
      front.collect(scene, NormalSides::Outside, kInfinity, seeds, none);
      const auto counts = ancestorCounts(cones_a, cones_b, front);
      for (std::uint32_t i = 0; i < cones_a.items().size(); ++i) {
        for (std::uint32_t j = 0; j < cones_b.items().size(); ++j) {
          if (!FeaturePairs::isWanted(cones_a.items()[i].kind, cones_b.items()[j].kind)) continue;
          const auto found = counts.find({i, j});
          ASSERT_EQ(found != counts.end() ? found->second : 0, 1)
              << "items " << i << " and " << j << ", instant " << k;
        }
      }
    }
  }
}

TEST(ConeFront, AsksNothingButLivePairsWhileTheBodiesStandStill) {
  const Body a = makeBody(test::concaveShape(0));
  const Body b = makeBody(test::concaveShape(3));
  const MinimaScene scene(*a, *b, test::translation(Vector3d(0.3, 0.2, 2.0)));
  ConeFront front;
  WorkLimit none;
  std::vector<MinimumSeed> first;
  std::vector<MinimumSeed> second;
  front.collect(scene, NormalSides::Outside, kInfinity, first, none);
  EXPECT_TRUE(front.counts().began_anew);
  EXPECT_GT(front.counts().kept, 0U);
  front.collect(scene, NormalSides::Outside, kInfinity, second, none);
  EXPECT_FALSE(front.counts().began_anew);
  EXPECT_EQ(front.counts().expired, 0U);
  EXPECT_EQ(front.counts().groups, 0U);
  EXPECT_EQ(front.counts().features, front.counts().live);
  EXPECT_EQ(placesOf(a, b, scene.a_from_b, first).size(), placesOf(a, b, scene.a_from_b, second).size());
}

TEST(ConeFront, GoesOnWhereALimitHasEndedIt) {
  RandomEngine engine(13);
  const Body a = makeBody(test::concaveShape(5));
  const Body b = makeBody(test::concaveShape(1));
  const Motion motion = randomMotion(engine);
  ConeFront front;
  const std::atomic<bool> stop{true};
  for (int k = 0; k < 40; ++k) {
    const Isometry3d pose = motion.at(0.01 * k);
    if (k % 4 == 1) {
      WorkLimit stopped(std::chrono::steady_clock::now(), kInfinity, std::numeric_limits<std::size_t>::max(),
                        &stop);
      std::vector<MinimumSeed> seeds;
      const bool done =
          front.collect(MinimaScene(*a, *b, pose), NormalSides::Outside, kInfinity, seeds, stopped);
      EXPECT_FALSE(done && front.counts().expired > 0);
    } else {
      expectWhatTheRootsFind(a, b, pose, NormalSides::Outside, kInfinity, front);
    }
  }
}

TEST(ConeFront, BeginsAnewForAnotherCutoffAndOtherSides) {
  const Body a = makeBody(test::concaveShape(2));
  const Body b = makeBody(test::concaveShape(4));
  const Isometry3d pose = test::translation(Vector3d(0.1, 0.2, 1.5));
  ConeFront front;
  expectWhatTheRootsFind(a, b, pose, NormalSides::Outside, 0.1, front);
  expectWhatTheRootsFind(a, b, pose, NormalSides::Outside, kInfinity, front);
  EXPECT_TRUE(front.counts().began_anew);
  expectWhatTheRootsFind(a, b, pose, NormalSides::Both, kInfinity, front);
  EXPECT_TRUE(front.counts().began_anew);
}

}  // namespace
}  // namespace concave_distance::detail
