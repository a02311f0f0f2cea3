#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "concave_distance/mesh/repair/repair_mesh.h"
#include "distance/kernels/pair_frame.h"
#include "distance/niches/minima_checks.h"
#include "mesh/surface/mesh_topology.h"
#include "mesh/surface/refine_mesh.h"
#include "support/painted_boxes.h"

// The proven list of niches on scenes whose niches are known, and what must not change its answer.

namespace concave_distance::local_minima_cases_test {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using test::Body;
using test::makeBody;
using test::makeCuboid;
using test::minimaOf;

constexpr double kError = 1e-12;

LocalMinimaRequest everyRipple() {
  LocalMinimaRequest request;
  request.rule.least_prominence = 0.0;
  return request;
}

TEST(LocalMinimaOf, BoxAboveABoxIsOnePatch) {
  for (const double max_edge : {10.0, 0.3, 0.1}) {
    const Body a =
        makeBody(refineToEdgeLength(makeCuboid(Vector3d(0, 0, 0), Vector3d(1, 1, 1)), max_edge).mesh);
    const Body b =
        makeBody(refineToEdgeLength(makeCuboid(Vector3d(0, 0, 0), Vector3d(1.4, 0.7, 0.5)), max_edge).mesh);
    const LocalMinima found = minimaOf(a, b, test::translation(Vector3d(0.3, -0.2, 1.25)), everyRipple());
    ASSERT_EQ(found.niches.size(), 1U);
    EXPECT_NEAR(found.niches[0].distance, 0.25, kError);
    EXPECT_EQ(found.niches[0].kind, NicheKind::Patch);
    EXPECT_NEAR(found.niches[0].extent, std::hypot(0.7, 0.5), 1e-9);
    EXPECT_TRUE(std::isinf(found.niches[0].prominence));
  }
}

TEST(LocalMinimaOf, BoxOnItsEdgeAboveABoxIsOneSegment) {
  const Body a = makeBody(makeCuboid(Vector3d::Zero(), Vector3d(1, 1, 1)));
  const Body b = makeBody(makeCuboid(Vector3d::Zero(), Vector3d(0.5, 0.9, 0.5)));
  Isometry3d pose = test::translation(Vector3d(0.4, 0.4, 1.2));
  pose.linear() = AngleAxisd(-0.3, Vector3d::UnitY()).toRotationMatrix();
  const LocalMinima found = minimaOf(a, b, pose, everyRipple());
  ASSERT_EQ(found.niches.size(), 1U);
  EXPECT_NEAR(found.niches[0].distance, 0.2, kError);
  EXPECT_EQ(found.niches[0].kind, NicheKind::Segment);
  EXPECT_NEAR(found.niches[0].extent, 0.6, 1e-9);
}

// Two shells, but a path leads from one to the other over the edge that they share.
TEST(LocalMinimaOf, CubesThatShareAnEdgeHaveOneNicheSeenFromFarAway) {
  TriangleSoup soup;
  test::addBox(soup, {Vector3d(0, 0, 0), Vector3d(1, 1, 1)}, 0, false);
  test::addBox(soup, {Vector3d(1, 1, 0), Vector3d(2, 2, 1)}, 0, false);
  const Body a = makeBody(repairMesh(soup, {}, "cubes").mesh);
  ASSERT_EQ(a->topology().shellCount(), 2U);
  const Body b = makeBody(makeCuboid(Vector3d::Zero(), Vector3d(0.1, 0.1, 0.1)));
  for (const double distance : {40.0, 300.0, 420.0, 1000.0, 1e6}) {
    for (const double least_prominence : {0.01, 0.5}) {
      LocalMinimaRequest request;
      request.rule.least_prominence = least_prominence;
      request.cutoff = std::numeric_limits<double>::infinity();
      const LocalMinima found = minimaOf(a, b, test::translation({distance, 0.3, 0.2}), request);
      EXPECT_EQ(found.niches.size(), 1U) << distance << " m, " << least_prominence;
    }
  }
}

TEST(LocalMinimaOf, TeethBetweenTeethAreOnePatchInEachSlit) {
  const Body a = makeBody(test::makeComb(3));
  Isometry3d pose = test::translation(Vector3d(0.725, 0.6, 0.0));
  pose.linear() = AngleAxisd(M_PI, Vector3d::UnitZ()).toRotationMatrix();
  LocalMinimaRequest request = everyRipple();
  request.cutoff = 0.03;
  const LocalMinima found = minimaOf(a, a, pose, request);
  ASSERT_EQ(found.niches.size(), 5U);
  for (const LocalMinimum& niche : found.niches) {
    EXPECT_NEAR(niche.distance, 0.025, kError);
    EXPECT_EQ(niche.kind, NicheKind::Patch);
    EXPECT_EQ(niche.outward, Outwardness::Outward);
    EXPECT_TRUE(niche.visible);
  }
}

TEST(LocalMinimaOf, OpenSheetsInParallelAreOnePatch) {
  const Body a = makeBody(test::makeSheet(10, 10));
  const LocalMinima found = minimaOf(a, a, test::translation(Vector3d(0.25, 0.15, -0.2)), everyRipple());
  ASSERT_EQ(found.niches.size(), 1U);
  EXPECT_NEAR(found.niches[0].distance, 0.2, kError);
  EXPECT_EQ(found.niches[0].kind, NicheKind::Patch);
  EXPECT_NEAR(found.niches[0].extent, std::hypot(0.75, 0.85), 1e-9);
}

TEST(LocalMinimaOf, BodiesThatMeetInTwoPlacesHaveTwoNichesOfDistanceZero) {
  // Both legs of a bridge go through a plate; they are one place each.
  const Body plate = makeBody(makeCuboid(Vector3d(-1, -1, 0), Vector3d(1, 1, 0.1)));
  const Body bridge = makeBody(test::makeExtrusion({{-0.5, -0.3},
                                                    {-0.4, -0.3},
                                                    {-0.4, 0.3},
                                                    {0.4, 0.3},
                                                    {0.4, -0.3},
                                                    {0.5, -0.3},
                                                    {0.5, 0.5},
                                                    {-0.5, 0.5}},
                                                   0.2));
  Isometry3d pose = Isometry3d::Identity();
  pose.linear() = AngleAxisd(0.5 * M_PI, Vector3d::UnitX()).toRotationMatrix();
  // Each goes through the upper and the lower face: two rims, of one part of the overlap.
  LocalMinimaRequest request = everyRipple();
  request.cutoff = 1e-3;
  const LocalMinima through = minimaOf(plate, bridge, pose, request);
  EXPECT_EQ(through.niches.size(), 2U);
  // Standing on it: two.
  pose.translation().z() = 0.4;
  const LocalMinima standing = minimaOf(plate, bridge, pose, request);
  ASSERT_EQ(standing.niches.size(), 2U);
  for (const LocalMinimum& niche : standing.niches) {
    EXPECT_EQ(niche.distance, 0.0);
    EXPECT_TRUE(std::isinf(niche.prominence));
  }
}

TEST(LocalMinimaOf, ABodySwallowedByAnotherLieOutwardsNowhere) {
  const Body outer = makeBody(makeCuboid(Vector3d(-1, -1, -1), Vector3d(1, 1, 1)));
  const Body inner = makeBody(makeCuboid(Vector3d(-0.1, -0.1, -0.1), Vector3d(0.1, 0.1, 0.1)));
  const Isometry3d pose = test::translation(Vector3d(0.3, 0.2, 0.1));
  EXPECT_TRUE(minimaOf(outer, inner, pose, everyRipple()).niches.empty());
  LocalMinimaRequest request = everyRipple();
  request.through_material = true;
  const LocalMinima found = minimaOf(outer, inner, pose, request);
  ASSERT_FALSE(found.niches.empty());
  EXPECT_NEAR(found.niches.front().distance, 0.6, kError);
  EXPECT_EQ(found.niches.front().outward, Outwardness::ThroughMaterial);
}

TEST(LocalMinimaOf, OutsideAreThoseOfBothSidesThatLeaveOutwards) {
  RandomEngine engine(11);
  for (std::uint32_t run = 0; run < 60; ++run) {
    SCOPED_TRACE("run " + std::to_string(run));
    const Body a = makeBody(test::concaveShape(uniformIndex(engine, 6)));
    const Body b = makeBody(test::concaveShape(uniformIndex(engine, 6)));
    const Isometry3d pose = test::randomPose(engine, 1.2);
    LocalMinimaRequest request;
    request.cutoff = 0.6;
    request.rule.least_prominence = run % 2 == 0 ? 0.0 : 1e-2;
    const LocalMinima outside = minimaOf(a, b, pose, request);
    request.through_material = true;
    std::vector<double> expected;
    for (const LocalMinimum& niche : minimaOf(a, b, pose, request).niches) {
      if (niche.outward != Outwardness::ThroughMaterial) expected.push_back(niche.distance);
    }
    ASSERT_EQ(outside.niches.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_NEAR(outside.niches[i].distance, expected[i], kError);
    }
    EXPECT_EQ(outside.cost.met_by_search, 0U);
  }
}

TEST(LocalMinimaOf, CombsAreCutAndCountedAsAsked) {
  const Body a = makeBody(test::makeComb(5));
  const Body b = makeBody(test::makeStairs(4));
  const Isometry3d pose = test::translation(Vector3d(0.1, 0.9, 0.13));
  LocalMinimaRequest request = everyRipple();
  const LocalMinima all = minimaOf(a, b, pose, request);
  ASSERT_GT(all.niches.size(), 4U);
  EXPECT_FALSE(all.cut);
  request.largest_count = 3;
  const LocalMinima some = minimaOf(a, b, pose, request);
  EXPECT_TRUE(some.cut);
  ASSERT_EQ(some.niches.size(), 3U);
  request = everyRipple();
  request.cutoff = 0.5 * (all.niches[2].distance + all.niches[3].distance);
  const LocalMinima near = minimaOf(a, b, pose, request);
  for (std::size_t i = 0; i < near.niches.size(); ++i) {
    EXPECT_EQ(near.niches[i].distance, all.niches[i].distance);
    EXPECT_LE(near.niches[i].distance, request.cutoff);
  }
}

TEST(LocalMinimaOf, TrianglePairsBelongToTheNicheTheyDescendTo) {
  RandomEngine engine(13);
  for (std::uint32_t run = 0; run < 20; ++run) {
    const Body a = makeBody(test::concaveShape(uniformIndex(engine, 6)));
    const Body b = makeBody(test::concaveShape(uniformIndex(engine, 6)));
    const Isometry3d pose = test::randomPose(engine, 1.2);
    LocalMinimaRequest request;
    request.rule.least_prominence = 0.1;
    request.through_material = true;
    for (int k = 0; k < 50; ++k) {
      request.asked_pairs.emplace_back(
          TriangleIndex{uniformIndex(engine, static_cast<std::uint32_t>(a->surface().triangleCount()))},
          TriangleIndex{uniformIndex(engine, static_cast<std::uint32_t>(b->surface().triangleCount()))});
    }
    const LocalMinima found = minimaOf(a, b, pose, request);
    EXPECT_EQ(found.cost.met_by_search, 0U);
    ASSERT_EQ(found.owners.size(), request.asked_pairs.size());
    RefinementWorkspace workspace;
    for (std::size_t k = 0; k < found.owners.size(); ++k) {
      ASSERT_LT(found.owners[k], found.niches.size());
      const double settled = std::sqrt(
          refineWitness(*a, *b, pose, request.asked_pairs[k].first, request.asked_pairs[k].second, workspace)
              .witness.squared_distance);
      EXPECT_LE(found.niches[found.owners[k]].distance, settled + kError);
    }
  }
}

// What is asked for or proposed beyond the cutoff can be no niche of the list: nothing is searched for it.
TEST(LocalMinimaOf, NothingIsSearchedBeyondTheCutoff) {
  const Body comb = makeBody(test::makeComb(5));
  const Isometry3d pose = test::translation(Vector3d(0.1, 0.2, 3.0));
  LocalMinimaRequest request;
  for (const double prominence_limit : {0.0, 1.0}) {
    request.rule.prominence_limit = prominence_limit;
    request.cutoff = std::numeric_limits<double>::infinity();
    request.asked_pairs.clear();
    request.proposals.clear();
    const LocalMinima all = minimaOf(comb, comb, pose, request);
    ASSERT_FALSE(all.niches.empty());
    const LocalMinimum& nearest = all.niches.front();
    request.cutoff = 0.99 * nearest.distance;
    request.asked_pairs.emplace_back(nearest.witness.triangle_a, nearest.witness.triangle_b);
    request.proposals.push_back(detail::PairFrame(*comb, *comb, pose).candidateOf(nearest.witness));
    LocalMinima near = minimaOf(comb, comb, pose, request);
    EXPECT_TRUE(near.niches.empty());
    EXPECT_EQ(near.cost.searched_pairs, 0U);
    EXPECT_EQ(near.owners, std::vector<std::size_t>{LocalMinima::kNoOwner});
    // The same for minima that are given.
    request.given = &request.proposals;
    near = minimaOf(comb, comb, pose, request);
    EXPECT_EQ(near.cost.searched_pairs, 0U);
    request.given = nullptr;
  }
}

struct Draw {
  Body a;
  Body b;
  Isometry3d pose;
};

Draw drawn() {
  RandomEngine engine(*rc::gen::arbitrary<std::uint64_t>());
  const auto a = uniformIndex(engine, 6);
  const auto b = uniformIndex(engine, 6);
  return {makeBody(test::concaveShape(a)), makeBody(test::concaveShape(b)), test::randomPose(engine, 1.2)};
}

LocalMinimaRequest someRipples(double scale = 1.0) {
  LocalMinimaRequest request;
  request.cutoff = 0.613 * scale;
  request.rule.prominence_limit = 1.0;
  return request;
}

void expectSame(const LocalMinima& l, const LocalMinima& r, double scale) {
  RC_ASSERT(l.niches.size() == r.niches.size());
  for (std::size_t i = 0; i < l.niches.size(); ++i) {
    RC_ASSERT(std::abs(l.niches[i].distance - r.niches[i].distance / scale) <= kError);
    RC_ASSERT(l.cost.met_by_search + r.cost.met_by_search == 0U);
  }
}

Body changed(const Body& body, double scale, const Isometry3d& motion) {
  std::vector<Vector3d> vertices = body->surface().vertices();
  for (Vector3d& v : vertices) v = scale * (motion * v);
  return makeBody(SurfaceMesh(std::move(vertices), body->surface().triangles(), "changed"));
}

RC_GTEST_PROP(LocalMinimaProperty, SwappingTheBodiesChangesNothing, ()) {
  const Draw d = drawn();
  expectSame(minimaOf(d.a, d.b, d.pose, someRipples()),
             minimaOf(d.b, d.a, d.pose.inverse(Eigen::Isometry), someRipples()), 1.0);
}

RC_GTEST_PROP(LocalMinimaProperty, MovingABodyWithinItsFrameChangesNothing, ()) {
  const Draw d = drawn();
  RandomEngine engine(*rc::gen::arbitrary<std::uint64_t>());
  const Isometry3d motion = test::randomPose(engine, 1.0);
  expectSame(
      minimaOf(d.a, d.b, d.pose, someRipples()),
      minimaOf(d.a, changed(d.b, 1.0, motion), d.pose * motion.inverse(Eigen::Isometry), someRipples()), 1.0);
}

RC_GTEST_PROP(LocalMinimaProperty, ScalingTheSceneScalesTheDistances, ()) {
  const Draw d = drawn();
  const double scale = std::ldexp(1.0, *rc::gen::inRange(-20, 21));
  Isometry3d pose = d.pose;
  pose.translation() *= scale;
  const Isometry3d stay = Isometry3d::Identity();
  expectSame(minimaOf(d.a, d.b, d.pose, someRipples()),
             minimaOf(changed(d.a, scale, stay), changed(d.b, scale, stay), pose, someRipples(scale)), scale);
}

}  // namespace
}  // namespace concave_distance::local_minima_cases_test
