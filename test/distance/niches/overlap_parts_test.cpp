#include "distance/niches/overlap_parts.h"

#include <gtest/gtest.h>

#include <map>

#include "distance/niches/local_minima.h"
#include "mesh/surface/mesh_topology.h"
#include "support/body_pairs.h"
#include "support/random_solids.h"
#include "support/wide_overlap.h"

// Each connected part of an overlap is one niche at distance 0: by hand, and against pieces cut and joined
// in long double.

namespace concave_distance::detail::overlap_parts_test {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test::makeBody;
using test::makeCuboid;
using test::makeJoined;
using test::makeTurned;
using test::translation;
using test::turned;
using Body = std::shared_ptr<const BodyMesh>;

Body box(const Vector3d& low, const Vector3d& high) {
  return makeBody(makeCuboid(low, high));
}

/// A plate of 2 m by 2 m, 0.1 m thick, with a wall on it so that it is not convex.
SurfaceMesh plate() {
  return test::makeExtrusion(
      {{-1.0, 0.0}, {1.0, 0.0}, {1.0, 0.1}, {0.9, 0.1}, {0.9, 0.3}, {0.8, 0.3}, {0.8, 0.1}, {-1.0, 0.1}},
      2.0);
}

SurfaceMesh hollow(double outer, double inner) {
  return makeJoined(makeCuboid(Vector3d::Constant(-outer), Vector3d::Constant(outer)),
                    makeTurned(makeCuboid(Vector3d::Constant(-inner), Vector3d::Constant(inner))),
                    Vector3d::Zero());
}

/// The niches at distance 0, by the whole search.
std::size_t nichesAtZero(const Body& a, const Body& b, const Isometry3d& pose, double margin = 0.0) {
  LocalMinimaRequest request;
  request.hidden = false;
  request.rule.margin = margin;
  const LocalMinima found = findLocalMinima(*a, *b, pose, request);
  EXPECT_TRUE(found.finished);
  std::size_t count = 0;
  for (const LocalMinimum& niche : found.niches) {
    if (niche.distance > 0.0) continue;
    ++count;
    EXPECT_LE((niche.witness.point_a_in_a - niche.witness.point_b_in_a).norm(), 1e-12);
  }
  return count;
}

TEST(OverlapParts, OfARodThroughAPlateIsOne) {
  const Body rod = makeBody(test::makeLShape(1.0, 0.1, 0.1));
  const Body through = makeBody(plate());
  for (const double depth : {0.05, 0.2, 0.5}) {
    EXPECT_EQ(nichesAtZero(through, rod, turned(0.2, {1.0, 0.3, 0.2}, {0.0, -depth, 0.0})), 1U) << depth;
  }
}

TEST(OverlapParts, OfLegsThroughAPlateAreAsManyAsThereAreLegs) {
  const Body through = makeBody(plate());
  EXPECT_EQ(nichesAtZero(through, makeBody(test::makeComb(4)), translation({-0.7, -0.2, 0.0})), 4U);
  // With its back in the plate it is one.
  EXPECT_EQ(nichesAtZero(through, makeBody(test::makeComb(4)), translation({-0.7, 0.05, 0.0})), 1U);
  EXPECT_EQ(nichesAtZero(through, makeBody(test::makeHook(0.8, 0.7)), translation({-0.7, -0.3, 0.0})), 2U);
}

TEST(OverlapParts, OfRodsThatAPlateCutsAreAsManyAsThereAreRods) {
  SurfaceMesh rods = makeCuboid({-0.05, -0.5, -0.05}, {0.05, 0.5, 0.05});
  for (int k = 1; k < 4; ++k) {
    rods = makeJoined(rods, makeCuboid({-0.05, -0.5, -0.05}, {0.05, 0.5, 0.05}), {-0.2 * k, 0.0, 0.1 * k});
  }
  EXPECT_EQ(nichesAtZero(makeBody(rods), makeBody(plate()), translation({0.0, 0.1, 0.0})), 4U);
}

TEST(OverlapParts, OfACombInACombAreThePlacesWhereTeethOverlap) {
  const Body comb = makeBody(test::makeComb(3));
  // The teeth, 0.1 wide and 0.15 apart, each cut into one neighbour, but for the last.
  const Isometry3d pose = turned(M_PI, Vector3d::UnitZ(), {0.68, 0.6, 0.03});
  EXPECT_EQ(nichesAtZero(comb, comb, pose), 3U);
}

TEST(OverlapParts, OfABoxAroundACavityIsOneThoughTwoSurfacesBoundIt) {
  // The cavity of each lies in the other's material but for a corner, and the outer faces cross.
  const Body first = makeBody(hollow(1.0, 0.2));
  const Isometry3d pose = translation({0.3, 0.3, 0.3});
  EXPECT_EQ(nichesAtZero(first, first, pose), 1U);
  // The walls' overlap is one piece around the cavity of a box that is larger all round.
  EXPECT_EQ(nichesAtZero(makeBody(hollow(2.0, 0.2)), first, pose), 1U);
  // A box that bridges the cavity ends in two walls; one that fills a corner, in one.
  const Body walls = makeBody(hollow(1.0, 0.8));
  const Body bar = makeBody(makeJoined(makeCuboid({-0.9, -0.1, -0.1}, {0.9, 0.1, 0.1}),
                                       makeCuboid({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}), {3.0, 0.0, 0.0}));
  EXPECT_EQ(nichesAtZero(walls, bar, Isometry3d::Identity()), 2U);
}

TEST(OverlapParts, WithoutPlacesWhereSurfacesMeetAreNone) {
  // One of two shells is swallowed, the other one crosses.
  const Body shells = makeBody(makeJoined(makeCuboid({-0.3, -0.3, -0.3}, {0.3, 0.3, 0.3}),
                                          makeCuboid({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}), {1.0, 0.0, 0.0}));
  const Body other = makeBody(test::makeLShape(3.0, 0.8, 0.8));
  EXPECT_EQ(nichesAtZero(other, shells, translation({0.01, 0.4, 0.0})), 1U);
  EXPECT_EQ(nichesAtZero(other, shells, translation({1.0, 0.4, 0.0})), 0U);
}

TEST(OverlapParts, OfAUnionHangTogetherInTheMaterialOfItsShells) {
  // A bar of three boxes that cross each other goes through the plate: three curves, one part.
  SurfaceMesh bar = makeCuboid({-0.5, -0.1, -0.1}, {0.5, 0.1, 0.1});
  bar = makeJoined(bar, makeCuboid({-0.5, -0.1, -0.1}, {0.5, 0.1, 0.1}), {0.3, 0.05, 0.04});
  bar = makeJoined(bar, makeCuboid({-0.5, -0.1, -0.1}, {0.5, 0.1, 0.1}), {-0.3, 0.06, -0.03});
  EXPECT_EQ(nichesAtZero(makeBody(plate()), makeBody(bar), translation({0.0, 0.1, 0.0})), 1U);
  // Inside one of its boxes a small one meets the other's wall, and that is no surface.
  EXPECT_EQ(nichesAtZero(makeBody(bar), box(Vector3d::Constant(-0.02), Vector3d::Constant(0.02)),
                         translation({0.2, 0.0, 0.0})),
            0U);
}

TEST(OverlapParts, OfSheetsAreThoseOfTheirSurfaces) {
  const Body sheet = makeBody(test::makeSheet(4, 4, 0.5));
  // The sheet's piece in a hook's legs is two rectangles; that in its bow is one.
  const Body hook = makeBody(test::makeHook(0.8, 0.7));
  const Isometry3d upright = turned(-M_PI / 2, Vector3d::UnitX(), {0.5, 1.03, 0.0});
  EXPECT_EQ(nichesAtZero(sheet, hook, upright * translation({0.0, -0.4, 0.0})), 2U);
  EXPECT_EQ(nichesAtZero(sheet, hook, upright * translation({0.0, -0.05, 0.0})), 1U);
  // Two sheets have a curve in common, and nothing is inside of either.
  const Body waves = makeBody(test::makeSheet(12, 3, 0.3, 0.1));
  const Isometry3d level = translation({0.1, 0.1, 0.01});
  EXPECT_GE(nichesAtZero(sheet, waves, level), 2U);
}

// Within a margin, parts are one niche where the padded surfaces hang together.
TEST(OverlapParts, AreOneWithinMarginsThatReachFromOneToTheOther) {
  const Body through = makeBody(plate());
  const Body hook = makeBody(test::makeHook(0.8, 0.7));  // the legs are 0.25 apart
  const Isometry3d pose = translation({-0.7, -0.3, 0.0});
  EXPECT_EQ(nichesAtZero(through, hook, pose, 0.1), 2U);
  EXPECT_EQ(nichesAtZero(through, hook, pose, 0.4), 1U);
}

/// Compares the parts that facet pairs are in with those of the oracle. Returns how many parts there are.
std::size_t expectPartsOfOracle(const Body& a, const Body& b, const Isometry3d& pose) {
  const PairFrame frame = PairFrame::withFacets(*a, *b, pose);
  OverlapParts overlap;
  LocalMinimaCost cost;
  WorkLimit none;
  EXPECT_TRUE(overlap.find(frame, false, cost, none));
  test::WideSurface surfaces[2];
  for (const bool is_of_b : {false, true}) {
    const BodyMesh& body = is_of_b ? *b : *a;
    for (std::size_t t = 0; t < body.surface().triangleCount(); ++t) {
      const TriangleIndex index{t};
      surfaces[is_of_b].triangles.push_back(
          test::exactTriangle<long double>(is_of_b ? frame.cornersOfB(index) : frame.cornersOfA(index)));
      surfaces[is_of_b].is_closed.push_back(body.topology().isOnClosedShell(index));
    }
  }
  const std::vector<int> parts = test::overlapPartsOfPairs(surfaces[0], surfaces[1], 1e-13L);
  std::map<int, std::uint32_t> ours;
  std::map<std::uint32_t, int> theirs;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::size_t count_b = b->surface().triangleCount();
    const TriangleIndex of_a{i / count_b};
    const TriangleIndex of_b{i % count_b};
    if (parts[i] < 0 || !frame.areOnSurface(of_a, of_b)) continue;
    const TrianglePair facets = frame.facetPairOf(of_a, of_b);
    const std::uint32_t part = overlap.partIn(facets.a, facets.b);
    EXPECT_NE(part, OverlapParts::kNone);
    EXPECT_EQ(ours.emplace(parts[i], part).first->second, part);
    EXPECT_EQ(theirs.emplace(part, parts[i]).first->second, parts[i]);
  }
  EXPECT_EQ(overlap.parts().size(), ours.size());
  return ours.size();
}

TEST(OverlapParts, AreThoseOfPiecesCutAndJoined) {
  RandomEngine engine(61);
  std::size_t several = 0;
  for (std::uint32_t run = 0; run < 150; ++run) {
    SCOPED_TRACE("run " + std::to_string(run));
    const Body a = makeBody(test::concaveShape(uniformIndex(engine, 6)));
    const Body b = run % 3 == 0 ? makeBody(hollow(0.4, test::uniformIn(engine, 0.1, 0.35)))
                                : makeBody(test::concaveShape(uniformIndex(engine, 6)));
    // Of two sheets the oracle does not follow the curves.
    if (!a->topology().allShellsClosed() && !b->topology().allShellsClosed()) continue;
    Isometry3d pose = test::randomPose(engine, 0.3);
    pose.pretranslate(a->surface().boundingBox().center());
    pose.translate(-b->surface().boundingBox().center());
    several += expectPartsOfOracle(a, b, pose) > 1 ? 1 : 0;
    if (HasFailure()) return;
  }
  EXPECT_GT(several, 40U);
}

// Whatever number of pairs is admitted, parts are right or said to be unknown.
TEST(OverlapParts, AreRightOrUnknownForAnyLimitOfPairs) {
  const Body a = makeBody(plate());
  const Body b = makeBody(test::makeComb(4));
  const PairFrame frame = PairFrame::withFacets(*a, *b, translation({-0.7, -0.2, 0.0}));
  std::size_t cut = 0;
  bool is_complete = false;
  for (std::size_t pairs = 0; !is_complete; ++pairs) {
    WorkLimit limit(WorkLimit::Clock::now(), std::numeric_limits<double>::infinity(), pairs, nullptr);
    OverlapParts overlap;
    LocalMinimaCost cost;
    is_complete = overlap.find(frame, true, cost, limit);
    const auto is_niche = [](const OverlapParts::Part& part) {
      return part.state == OverlapParts::State::Niche;
    };
    const auto niches = std::count_if(overlap.parts().begin(), overlap.parts().end(), is_niche);
    if (is_complete) {
      EXPECT_EQ(niches, 4);
    } else {
      ++cut;
      EXPECT_TRUE(limit.hasRefusedPairs());
      EXPECT_LE(niches, 1);
    }
    ASSERT_LT(pairs, 10000U);
  }
  EXPECT_GT(cut, 10U);
}

}  // namespace
}  // namespace concave_distance::detail::overlap_parts_test
