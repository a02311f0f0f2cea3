#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <algorithm>

#include "concave_distance/interference/interference.h"
#include "interference/interference_checks.h"
#include "support/any_surface.h"
#include "support/body_pairs.h"
#include "support/count_allocations.h"
#include "support/mesh_variants.h"
#include "support/random_solids.h"

namespace concave_distance::interference_invariance_test {
namespace {

struct RandomPair {
  SurfaceMesh a;
  SurfaceMesh b;
  Eigen::Isometry3d a_from_b;
};

RandomPair randomPair(std::uint64_t seed) {
  RandomEngine engine(seed);
  RandomPair pair{test::randomSolid(engine), test::randomSolid(engine), Eigen::Isometry3d::Identity()};
  pair.a_from_b = test::randomOverlappingPose(pair.a, pair.b, engine);
  return pair;
}

/// What two ways of asking for the same regions may differ by: vertices move by `moved` metres, which moves
/// the ends of a region along its surfaces and edges by more the flatter they cross, 1e4 in the worst of
/// these pairs.
struct Allowed {
  double moved;
  double size;  ///< metres
  double length() const { return 1e4 * moved; }
};

/// Regions of `result` mapped by a motion and a scale factor, sides exchanged or not, against those expected.
void expectSame(const Interference& expected, const Interference& result, const Eigen::Isometry3d& motion,
                double factor, bool swapped, const Allowed& allowed) {
  ASSERT_EQ(result.regions.size(), expected.regions.size());
  std::vector<bool> taken(result.regions.size(), false);
  for (const InterferenceRegion& e : expected.regions) {
    const Eigen::Vector3d centroid = motion * (factor * e.centroid_in_a);
    std::size_t nearest = 0;
    double distance = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < result.regions.size(); ++i) {
      const double to = (result.regions[i].centroid_in_a - centroid).norm();
      if (!taken[i] && to < distance) {
        nearest = i;
        distance = to;
      }
    }
    taken[nearest] = true;
    const InterferenceRegion& r = result.regions[nearest];
    const double length = factor * allowed.length();
    const double size = factor * allowed.size;
    EXPECT_EQ(r.loop_count, e.loop_count);
    EXPECT_EQ(r.closed, e.closed);
    EXPECT_NEAR(r.volume, factor * factor * factor * e.volume, length * size * size);
    EXPECT_NEAR(r.contact_area, factor * factor * e.contact_area, length * size);
    EXPECT_NEAR(swapped ? r.surface_area_b : r.surface_area_a, factor * factor * e.surface_area_a,
                length * size);
    EXPECT_NEAR(swapped ? r.surface_area_a : r.surface_area_b, factor * factor * e.surface_area_b,
                length * size);
    // A fallback chooses among equals; and the direction of a small vector area turns by more.
    const double area = factor * factor * e.contact_area;
    if (e.normal_is_fallback || r.normal_is_fallback || area < 1e-3 * size * size) continue;
    const Eigen::Vector3d normal = (swapped ? -1.0 : 1.0) * (motion.linear() * e.normal_in_a);
    EXPECT_NEAR((r.normal_in_a - normal).norm(), 0.0, length * size / area);
    EXPECT_NEAR(r.depth_along_normal, factor * e.depth_along_normal, length * size * size / area);
  }
}

class InterferenceInvariance : public testing::Test {
 protected:
  template <typename Check>
  void forRandomPairs(std::uint64_t count, const Check& check) {
    std::size_t overlapping = 0;
    for (std::uint64_t seed = 1000; seed < 1000 + count; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      const RandomPair pair = randomPair(seed);
      const Interference result = test::interferenceOf(pair.a, pair.b, pair.a_from_b);
      overlapping += result.regions.empty() ? 0U : 1U;
      check(pair, result, Allowed{result.rounding_bound, std::max(pair.a.diameter(), pair.b.diameter())});
    }
    EXPECT_GT(2 * overlapping, count);
  }
};

TEST_F(InterferenceInvariance, SwappingTheBodiesSwapsTheSides) {
  forRandomPairs(80, [](const RandomPair& pair, const Interference& result, const Allowed& allowed) {
    const Eigen::Isometry3d back = pair.a_from_b.inverse();
    expectSame(result, test::interferenceOf(pair.b, pair.a, back), back, 1.0, true, allowed);
  });
}

TEST_F(InterferenceInvariance, MovingBothBodiesMovesTheRegions) {
  forRandomPairs(80, [](const RandomPair& pair, const Interference& result, const Allowed& allowed) {
    Eigen::Isometry3d motion = test::slanted();
    motion.pretranslate(Eigen::Vector3d(3, -2, 1));
    const Interference moved =
        test::interferenceOf(test::movedSurface(pair.a, motion), pair.b, motion * pair.a_from_b);
    expectSame(result, moved, motion, 1.0, false, {moved.rounding_bound, allowed.size});
  });
}

TEST_F(InterferenceInvariance, ScalingScalesTheRegions) {
  forRandomPairs(80, [](const RandomPair& pair, const Interference& result, const Allowed& allowed) {
    for (const double factor : {1e-3, 1e3, 0x1.0p20}) {
      Eigen::Isometry3d pose = pair.a_from_b;
      pose.translation() *= factor;
      const Interference scaled = test::interferenceOf(test::scaledSurface(pair.a, factor),
                                                       test::scaledSurface(pair.b, factor), pose);
      expectSame(result, scaled, Eigen::Isometry3d::Identity(), factor, false, allowed);
    }
  });
}

// Prongs in a row through one triangle: a loop's way out meets the next loops exactly at their corners.
TEST_F(InterferenceInvariance, LoopsInARowInOneTriangleStayRegionsOfTheirOwn) {
  for (const std::uint64_t seed : {10506U, 6716U}) {
    const RandomPair pair = randomPair(seed);
    const std::size_t regions = test::interferenceOf(pair.a, pair.b, pair.a_from_b).regions.size();
    EXPECT_GT(regions, 1u);
    for (int i = 0; i < 60; ++i) {
      const double factor = 1e-3 * (1.0 + 0.01 * i);
      Eigen::Isometry3d pose = pair.a_from_b;
      pose.translation() *= factor;
      EXPECT_EQ(
          test::interferenceOf(test::scaledSurface(pair.a, factor), test::scaledSurface(pair.b, factor), pose)
              .regions.size(),
          regions)
          << seed << " scaled by " << factor;
    }
  }
}

TEST_F(InterferenceInvariance, FarFromTheOriginOnlyTheRoundingOfTheCoordinatesIsLost) {
  forRandomPairs(80, [](const RandomPair& pair, const Interference& result, const Allowed& allowed) {
    const Eigen::Isometry3d motion = test::translation({1048576.0, -524288.0, 262144.0});
    const Interference far =
        test::interferenceOf(test::movedSurface(pair.a, motion), pair.b, motion * pair.a_from_b);
    expectSame(result, far, motion, 1.0, false, {far.rounding_bound, allowed.size});
  });
}

TEST_F(InterferenceInvariance, HalvingEveryEdgeChangesNothing) {
  forRandomPairs(24, [](const RandomPair& pair, const Interference& result, const Allowed& allowed) {
    const Interference halved =
        test::interferenceOf(test::halvedEdges(pair.a), test::halvedEdges(pair.b), pair.a_from_b);
    expectSame(result, halved, Eigen::Isometry3d::Identity(), 1.0, false, allowed);
    const Interference one_halved =
        test::interferenceOf(test::halvedEdges(test::halvedEdges(pair.a)), pair.b, pair.a_from_b);
    expectSame(result, one_halved, Eigen::Isometry3d::Identity(), 1.0, false, allowed);
  });
}

TEST(InterferenceOfAlignedBoxes, HasVolumeAndAreaWhateverIsFlush) {
  // Corners on a grid of quarters: faces, edges and corners coincide in every way. Exact in doubles.
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    RandomEngine engine(seed);
    Eigen::Vector3d low[2];
    Eigen::Vector3d high[2];
    for (int body = 0; body < 2; ++body) {
      for (int axis = 0; axis < 3; ++axis) {
        low[body][axis] = 0.25 * uniformIndex(engine, 4);
        high[body][axis] = low[body][axis] + 0.25 * (1 + uniformIndex(engine, 3));
      }
    }
    const Eigen::Vector3d extent = high[0].cwiseMin(high[1]) - low[0].cwiseMax(low[1]);
    const double volume = extent.minCoeff() > 0.0 ? extent.prod() : 0.0;
    const Interference result = test::interferenceOf(
        test::makeCuboid(low[0], high[0]), test::makeCuboid(low[1], high[1]), Eigen::Isometry3d::Identity());
    double sum = 0.0;
    std::size_t solid = 0;
    for (const InterferenceRegion& region : result.regions) {
      sum += region.volume;
      solid += region.touching ? 0U : 1U;
      EXPECT_TRUE(region.consistent && region.closed) << seed;
      if (region.touching) continue;
      EXPECT_NEAR(region.surface_area_a + region.surface_area_b,
                  2.0 * (extent.x() * extent.y() + extent.y() * extent.z() + extent.z() * extent.x()), 1e-13)
          << seed;
      EXPECT_GE(region.depth_along_normal, extent.minCoeff() - 1e-13) << seed;
    }
    EXPECT_NEAR(sum, volume, 1e-13) << seed;
    EXPECT_EQ(solid, volume > 0.0 ? 1u : 0u) << seed;
    // A common face without volume is a region that touches, with that face as its area.
    if (volume == 0.0 && extent.minCoeff() == 0.0 && (extent.array() > 0.0).count() == 2) {
      ASSERT_EQ(result.regions.size(), 1u) << seed;
      EXPECT_NEAR(result.regions[0].contact_area, (extent.array() > 0.0).select(extent.array(), 1.0).prod(),
                  1e-13)
          << seed;
    }
    EXPECT_TRUE(extent.minCoeff() >= 0.0 || result.regions.empty()) << seed;
  }
}

RC_GTEST_PROP(InterferenceOfAnySurfaces, EndsAndNumbersAreFiniteOrNotGiven, ()) {
  const SurfaceMesh a = *test::anySurface();
  const SurfaceMesh b = *test::anySurface();
  RandomEngine engine(*rc::gen::arbitrary<std::uint64_t>());
  const Interference result = test::interferenceOf(
      a, b,
      *rc::gen::element(Eigen::Isometry3d(Eigen::Isometry3d::Identity()), test::randomPose(engine, 0.3)));
  for (const InterferenceRegion& region : result.regions) {
    RC_ASSERT(region.centroid_in_a.allFinite());
    RC_ASSERT(region.normal_in_a.allFinite());
    RC_ASSERT(region.point_a_in_a.allFinite() && region.point_b_in_a.allFinite());
    RC_ASSERT(!region.closed || (std::isfinite(region.volume) && region.depth_along_normal >= 0.0));
  }
}

TEST(Interference, AllocatesNothingOnceItsWorkspaceHasGrown) {
  const auto a = test::makeBody(makeSphere(0.5, 1e-3));
  const auto b = test::makeBody(test::makeComb(4));
  const auto c = test::makeBody(makeBox({1, 1, 1}));
  InterferenceWorkspace workspace;
  Interference result;
  std::size_t before = 0;
  for (int round = 0; round < 3; ++round) {
    if (round == 2) before = allocations;
    findInterference(*a, *b, test::translation({0.1, 0.2, 0.1}), workspace, result);
    EXPECT_FALSE(result.regions.empty());
    findInterference(*c, *c, test::translation({0.25, 0.0, 0.0}), workspace, result);  // flush: two passes
    EXPECT_FALSE(result.regions.empty());
    findInterference(*c, *a, test::translation({0.0, 0.0, 0.0}), workspace,
                     result);  // swallowed but for touching
    EXPECT_FALSE(result.regions.empty());
  }
  EXPECT_EQ(allocations, before);
}

}  // namespace
}  // namespace concave_distance::interference_invariance_test
