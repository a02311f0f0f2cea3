#include <gtest/gtest.h>

#include <cmath>

#include "distance/bound/certificate.h"
#include "distance/niches/niche_properties.h"
#include "mesh/surface/mesh_topology.h"
#include "mesh/surface/refine_mesh.h"
#include "support/body_pairs.h"
#include "support/enumeration.h"
#include "support/mesh_variants.h"

namespace concave_distance::niche_extent_test {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using test::makeBody;
using test::makeCuboid;

constexpr double kTolerance = 1e-9;
constexpr std::size_t kPairLimit = 10000;

using Body = std::shared_ptr<const BodyMesh>;

WitnessPair refined(const Body& a, const Body& b, const Isometry3d& pose, TriangleIndex start_a,
                    TriangleIndex start_b) {
  RefinementWorkspace workspace;
  const WitnessRefinement refinement = refineWitness(*a, *b, pose, start_a, start_b, workspace);
  EXPECT_TRUE(refinement.proven);
  return refinement.witness;
}

NicheExtent extentOf(const Body& a, const Body& b, const Isometry3d& pose, const WitnessPair& witness,
                     double tolerance = kTolerance) {
  ExtentWorkspace workspace;
  const NicheExtent extent = measureExtent(*a, *b, pose, witness, tolerance, kPairLimit, workspace);
  EXPECT_NEAR(std::sqrt(extent.representative.squared_distance), std::sqrt(witness.squared_distance),
              4.0 * tolerance + 1e-14);
  return extent;
}

WitnessPair certifiedWitness(const Body& a, const Body& b, const Isometry3d& pose) {
  CertificateWorkspace workspace;
  return certifyDistance(*a, *b, pose, nullptr, 0, CertificateRequest(), workspace).witness;
}

NicheExtent extentOfClosest(const Body& a, const Body& b, const Isometry3d& pose) {
  return extentOf(a, b, pose, test::enumerateTrianglePairs(*a, *b, pose));
}

/// From each triangle pair whose refinement ends at the least distance, and with the bodies exchanged: always
/// the same set.
void expectSameFromEveryStart(const Body& a, const Body& b, const Isometry3d& pose, NicheKind kind,
                              double length, const Vector3d& middle_on_a, const Vector3d& middle_on_b,
                              double error) {
  const double least = std::sqrt(test::enumerateTrianglePairs(*a, *b, pose).squared_distance);
  int starts = 0;
  for (std::uint32_t i = 0; i < a->surface().triangleCount(); ++i) {
    for (std::uint32_t j = 0; j < b->surface().triangleCount(); ++j) {
      const WitnessPair witness = refined(a, b, pose, TriangleIndex{i}, TriangleIndex{j});
      if (std::sqrt(witness.squared_distance) > least + kTolerance) continue;
      ++starts;
      const NicheExtent extent = extentOf(a, b, pose, witness);
      ASSERT_EQ(extent.kind, kind);
      ASSERT_NEAR(extent.length, length, error);
      ASSERT_LT((extent.representative.point_a_in_a - middle_on_a).norm(), error);
      ASSERT_LT((extent.representative.point_b_in_a - middle_on_b).norm(), error);
      EXPECT_FALSE(extent.cut);
      EXPECT_FALSE(extent.leads_down);
    }
  }
  EXPECT_GT(starts, 0);
  const Isometry3d back = pose.inverse(Eigen::Isometry);
  const NicheExtent mirrored = extentOfClosest(b, a, back);
  EXPECT_EQ(mirrored.kind, kind);
  EXPECT_NEAR(mirrored.length, length, error);
  EXPECT_LT((pose * mirrored.representative.point_b_in_a - middle_on_a).norm(), error);
  EXPECT_LT((pose * mirrored.representative.point_a_in_a - middle_on_b).norm(), error);
}

TEST(MeasureExtent, BoxAboveABoxIsOnePatchAroundTheMiddleOfTheOverlap) {
  //            +-----+  b: [0.3, 1.7] x [-0.2, 0.5], 0.25 above
  //   +--------|--+  |
  //   |  a     +--|--+
  //   +-----------+     a: [0, 1] x [0, 1]
  const Body a = makeBody(makeCuboid(Vector3d(0, 0, 0), Vector3d(1, 1, 1)));
  const Body b = makeBody(makeCuboid(Vector3d(0, 0, 0), Vector3d(1.4, 0.7, 0.5)));
  const Isometry3d pose = test::translation(Vector3d(0.3, -0.2, 1.25));
  expectSameFromEveryStart(a, b, pose, NicheKind::Patch, std::hypot(0.7, 0.5), Vector3d(0.65, 0.25, 1),
                           Vector3d(0.65, 0.25, 1.25), 1e-12);
}

TEST(MeasureExtent, PatchStaysOnePatchOnRefinedAndTurnedFaces) {
  const Vector3d size(1, 1, 1);
  const Body a = makeBody(refineToEdgeLength(makeCuboid(Vector3d::Zero(), size), 0.3).mesh);
  const Body b =
      makeBody(refineToEdgeLength(makeCuboid(Vector3d::Zero(), Vector3d(0.5, 0.4, 0.3)), 0.2).mesh);
  RandomEngine engine(1);
  for (int i = 0; i < 20; ++i) {
    // Both bodies turned together: the faces are parallel up to rounding only.
    const Isometry3d world_from_a = test::randomPose(engine, 1.0);
    const Vector3d corner(test::uniformIn(engine, 0.0, 0.5), test::uniformIn(engine, 0.0, 0.6), 1.125);
    const Isometry3d world_from_b = world_from_a * test::translation(corner);
    const Isometry3d pose = world_from_a.inverse(Eigen::Isometry) * world_from_b;
    const NicheExtent extent = extentOfClosest(a, b, pose);
    EXPECT_EQ(extent.kind, NicheKind::Patch);
    EXPECT_NEAR(extent.length, std::hypot(0.5, 0.4), 1e-7);
    EXPECT_LT((extent.representative.point_a_in_a - (corner + Vector3d(0.25, 0.2, -0.125))).norm(), 1e-7);
    EXPECT_FALSE(extent.cut);
  }
}

TEST(MeasureExtent, TiltedBoxStandsOnASegment) {
  // b is turned by 0.3 rad about y: its lower edge along y is the closest part; only y in [0.4, 1] is over a.
  const Body a = makeBody(makeCuboid(Vector3d::Zero(), Vector3d(1, 1, 1)));
  const Body b = makeBody(makeCuboid(Vector3d::Zero(), Vector3d(0.5, 0.9, 0.5)));
  Isometry3d pose = test::translation(Vector3d(0.4, 0.4, 1.2));
  pose.linear() = AngleAxisd(-0.3, Vector3d::UnitY()).toRotationMatrix();
  expectSameFromEveryStart(a, b, pose, NicheKind::Segment, 0.6, Vector3d(0.4, 0.7, 1.0),
                           Vector3d(0.4, 0.7, 1.2), 1e-12);
}

TEST(MeasureExtent, ParallelEdgesShareTheirCommonStretch) {
  // Two rods of square section, turned by 45 degrees, edge to edge along x.
  const SurfaceMesh rod = makeCuboid(Vector3d(0, -0.1, -0.1), Vector3d(1, 0.1, 0.1));
  const Body a = makeBody(rod);
  const Body b = makeBody(rod);
  Isometry3d turned = Isometry3d::Identity();
  turned.linear() = AngleAxisd(M_PI / 4, Vector3d::UnitX()).toRotationMatrix();
  const double reach = 0.1 * std::sqrt(2.0);
  const Isometry3d pose =
      turned.inverse(Eigen::Isometry) * test::translation(Vector3d(0.25, 0, 2 * reach + 0.05)) * turned;
  const Vector3d on_a = turned.inverse(Eigen::Isometry) * Vector3d(0.625, 0, reach);
  const Vector3d on_b = turned.inverse(Eigen::Isometry) * Vector3d(0.625, 0, reach + 0.05);
  expectSameFromEveryStart(a, b, pose, NicheKind::Segment, 0.75, on_a, on_b, 1e-7);
}

TEST(MeasureExtent, EdgesParallelUpToTheToleranceAreASegment) {
  // The same rods, turned against one another about the line between their edges: over the common stretch the
  // distance grows by (0.375 angle)^2 / 2 d, up to a tenth of the tolerance.
  const SurfaceMesh rod = makeCuboid(Vector3d(0, -0.1, -0.1), Vector3d(1, 0.1, 0.1));
  const Body a = makeBody(rod);
  const Body b = makeBody(rod);
  Isometry3d turned = Isometry3d::Identity();
  turned.linear() = AngleAxisd(M_PI / 4, Vector3d::UnitX()).toRotationMatrix();
  const double reach = 0.1 * std::sqrt(2.0);
  for (const double angle : {1e-15, 1e-12, 1e-9, 1e-7, 1e-6, 8e-6}) {
    Isometry3d twist = test::translation(Vector3d(0.625, 0, 0));
    twist.linear() = AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix();
    const Isometry3d pose = turned.inverse(Eigen::Isometry) * twist *
                            test::translation(Vector3d(-0.375, 0, 2 * reach + 0.05)) * turned;
    const NicheExtent extent = extentOfClosest(a, b, pose);
    EXPECT_EQ(extent.kind, NicheKind::Segment) << angle;
    EXPECT_NEAR(extent.length, 0.75, 1e-5) << angle;
    EXPECT_NEAR(extent.representative.point_a_in_a.x(), 0.625, 1e-5) << angle;
  }
  // Ten times farther it is a crossing.
  Isometry3d twist = test::translation(Vector3d(0.625, 0, 0));
  twist.linear() = AngleAxisd(1e-3, Vector3d::UnitZ()).toRotationMatrix();
  const Isometry3d pose = turned.inverse(Eigen::Isometry) * twist *
                          test::translation(Vector3d(-0.375, 0, 2 * reach + 0.05)) * turned;
  const NicheExtent crossing = extentOfClosest(a, b, pose);
  EXPECT_EQ(crossing.kind, NicheKind::Point);
  EXPECT_NEAR(crossing.representative.point_a_in_a.x(), 0.625, 1e-5);
}

TEST(MeasureExtent, FacesSideBySideUpToTheToleranceShareTheirBorder) {
  // Two boxes, one above and beside the other, their nearest edges parallel but for a twist of 1e-7.
  const Body a = makeBody(makeCuboid(Vector3d(-1, -1, -1), Vector3d(0, 1, 0)));
  const Body b = makeBody(makeCuboid(Vector3d(0, -0.5, 0), Vector3d(1, 0.5, 1)));
  for (const double angle : {-1e-7, -1e-12, 0.0, 1e-12, 1e-7}) {
    Isometry3d pose = test::translation(Vector3d(0, 0, 0.2));
    pose.linear() = AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix();
    const NicheExtent extent = extentOfClosest(a, b, pose);
    EXPECT_EQ(extent.kind, NicheKind::Segment) << angle;
    EXPECT_NEAR(extent.length, 1.0, 1e-5) << angle;
    EXPECT_NEAR(extent.representative.point_a_in_a.y(), 0.0, 1e-5) << angle;
  }
}

TEST(MeasureExtent, EdgesInOneLineShareTheirOverlapWhateverTheRoundingOfTheirCrossing) {
  // Two L shapes, edges along one direction: a's from y = 0 to 0.6, b's from 0.45 to 0.65. Seen along the
  // way between them they lie in one line, and the crossing of the two is 0 / 0 up to rounding.
  const Body a = makeBody(test::makeLShape());
  Isometry3d pose = test::translation(Vector3d(-0.4, 0.55, -0.5));
  pose.linear() << 0, -1, 0, 0, 0, 1, -1, 0, 0;
  const NicheExtent extent = extentOfClosest(a, a, pose);
  EXPECT_EQ(extent.kind, NicheKind::Segment);
  EXPECT_NEAR(extent.length, 0.15, 1e-12);
}

TEST(MeasureExtent, CornersAndCrossedEdgesArePoints) {
  RandomEngine engine(2);
  const Body a = makeBody(makeCuboid(Vector3d(-1, -1, -1), Vector3d(1, 1, 1)));
  const Body b = makeBody(makeCuboid(Vector3d(-0.5, -0.6, -0.7), Vector3d(0.5, 0.6, 0.7)));
  for (int i = 0; i < 100; ++i) {
    Isometry3d pose = test::randomPose(engine, 0.1);
    pose.translation() += 3.5 * test::randomRotation(engine).col(0);
    const WitnessPair witness = test::enumerateTrianglePairs(*a, *b, pose);
    const NicheExtent extent = extentOf(a, b, pose, witness);
    EXPECT_EQ(extent.kind, NicheKind::Point);
    EXPECT_EQ(extent.length, 0.0);
    EXPECT_EQ(extent.representative.point_a_in_a, witness.point_a_in_a);
    EXPECT_EQ(extent.representative.point_b_in_a, witness.point_b_in_a);
  }
}

TEST(MeasureExtent, ToothBetweenTeethHasAPatchOnEitherSide) {
  // Combs of three teeth 0.1 wide, 0.15 apart: b turned over and moved half a pitch, its teeth in a's gaps.
  const Body a = makeBody(test::makeComb(3));
  const Body b = makeBody(test::makeComb(3));
  Isometry3d pose = test::translation(Vector3d(0.725, 0.6, 0.0));
  pose.linear() = AngleAxisd(M_PI, Vector3d::UnitZ()).toRotationMatrix();
  // Teeth of a: x in [0, 0.1], [0.25, 0.35], [0.5, 0.6] up to y = 0.4. Of b, seen from a: x in
  // [0.625, 0.725], [0.375, 0.475], [0.125, 0.225] down to y = 0.2: 0.025 from a's teeth on both sides.
  RefinementWorkspace workspace;
  std::vector<double> middles;
  for (std::uint32_t i = 0; i < a->surface().triangleCount(); ++i) {
    for (std::uint32_t j = 0; j < b->surface().triangleCount(); ++j) {
      const WitnessPair witness = refined(a, b, pose, TriangleIndex{i}, TriangleIndex{j});
      if (std::sqrt(witness.squared_distance) > 0.025 + kTolerance) continue;
      const NicheExtent extent = extentOf(a, b, pose, witness);
      EXPECT_EQ(extent.kind, NicheKind::Patch);
      EXPECT_NEAR(extent.length, std::hypot(0.2, 0.2), 1e-7);
      EXPECT_NEAR(extent.representative.point_a_in_a.y(), 0.3, 1e-7);
      EXPECT_NEAR(extent.representative.point_a_in_a.z(), 0.0, 1e-7);
      const double middle =
          0.5 * (extent.representative.point_a_in_a.x() + extent.representative.point_b_in_a.x());
      if (std::none_of(middles.begin(), middles.end(),
                       [&](double known) { return std::abs(known - middle) < 1e-7; })) {
        middles.push_back(middle);
      }
    }
  }
  EXPECT_EQ(middles.size(), 5U);  // in each of the five slits one, not many
}

TEST(MeasureExtent, SaysWhenItCut) {
  const Body a = makeBody(test::makeSheet(10, 10));
  const Body b = makeBody(test::makeSheet(10, 10));
  const Isometry3d pose = test::translation(Vector3d(0, 0, 0.2));
  const WitnessPair witness = test::enumerateTrianglePairs(*a, *b, pose);
  ExtentWorkspace workspace;
  EXPECT_TRUE(measureExtent(*a, *b, pose, witness, kTolerance, 20, workspace).cut);
  const NicheExtent whole = measureExtent(*a, *b, pose, witness, kTolerance, kPairLimit, workspace);
  EXPECT_FALSE(whole.cut);
  EXPECT_NEAR(whole.length, std::sqrt(2.0), 1e-12);
  EXPECT_LT((whole.representative.point_a_in_a - Vector3d(0.5, 0.5, 0.0)).norm(), 1e-12);
}

TEST(MeasureExtent, TerraceThatLeadsDownIsNoMinimum) {
  // a is level for 0 < x < 1 and then rises towards b, which is level above all of it.
  const Body a =
      makeBody(test::makeSurface({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0.5}, {2, 1, 0.5}},
                                 {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}}));
  const Body b = makeBody(makeCuboid(Vector3d(-1, -1, 1), Vector3d(3, 2, 2)));
  const Isometry3d pose = Isometry3d::Identity();
  RefinementWorkspace workspace;
  const TriangleIndex under_b = test::enumerateTrianglePairs(*a, *b, pose).triangle_b;
  // The far corner of the terrace: its own surroundings are level.
  const Vector3d above(0, 0.5, 1);
  WitnessPair witness;
  witness.squared_distance = 1.0;
  witness.point_a_in_a = Vector3d(0, 0.5, 0);
  witness.point_b_in_a = above;
  witness.triangle_a = TriangleIndex{1};
  witness.feature_a = Feature::Edge2;
  for (std::uint32_t t = 0; t < b->surface().triangleCount(); ++t) {
    const TrianglePoints corners = {b->surface().corner(TriangleIndex{t}, 0),
                                    b->surface().corner(TriangleIndex{t}, 1),
                                    b->surface().corner(TriangleIndex{t}, 2)};
    const PointTriangleDistance on = pointTriangleDistance(above, corners);
    if (on.squared_distance == 0.0) {
      witness.triangle_b = TriangleIndex{t};
      witness.feature_b = on.feature;
    }
  }
  const NicheExtent extent = extentOf(a, b, pose, witness);
  ASSERT_TRUE(extent.leads_down);
  EXPECT_NEAR(extent.length, std::sqrt(2.0), 1e-12);
  const WitnessRefinement further = refineWitness(*a, *b, pose, extent.down_a, extent.down_b, workspace);
  EXPECT_NEAR(further.witness.squared_distance, 0.25, 1e-12);
  EXPECT_NE(under_b, kNoTriangle);
  const NicheExtent there = extentOf(a, b, pose, further.witness);
  EXPECT_FALSE(there.leads_down);
  EXPECT_EQ(there.kind, NicheKind::Segment);
}

TEST(MeasureExtent, RimOverAPlaneIsOnePatchWhoseRepresentativeLiesOnTheRim) {
  // An open box upside down over a plane: its rim is a closed chain of edges, all equally close.
  SurfaceMesh box = makeCuboid(Vector3d(-0.5, -0.3, 0), Vector3d(0.5, 0.3, 1));
  std::vector<TriangleNodes> sides;
  for (std::uint32_t t = 0; t < box.triangleCount(); ++t) {
    const TriangleIndex triangle{t};
    const bool is_bottom = box.corner(triangle, 0).z() == 0 && box.corner(triangle, 1).z() == 0 &&
                           box.corner(triangle, 2).z() == 0;
    if (!is_bottom) sides.push_back(box.triangle(triangle));
  }
  const Body a = makeBody(SurfaceMesh(box.vertices(), sides, "cup"));
  const Body b = makeBody(test::makeSheet(4, 4, 1.0));
  const Isometry3d pose = test::translation(Vector3d(-2.1, -1.9, -0.4));
  const NicheExtent extent = extentOfClosest(a, b, pose);
  EXPECT_EQ(extent.kind, NicheKind::Patch);
  EXPECT_NEAR(extent.length, std::hypot(1.0, 0.6), 1e-12);
  EXPECT_NEAR(std::abs(extent.representative.point_a_in_a.y()), 0.3, 1e-12);
  EXPECT_NEAR(extent.representative.point_a_in_a.x(), 0.0, 1e-12);
}

TEST(MeasureExtent, TouchingWitnessesArePoints) {
  const Body a = makeBody(makeCuboid(Vector3d::Zero(), Vector3d::Ones()));
  const Isometry3d pose = test::translation(Vector3d(0.25, 0.25, 1.0));
  const NicheExtent extent = extentOfClosest(a, a, pose);
  EXPECT_EQ(extent.kind, NicheKind::Point);
}

// The sideways tolerance grows with the root of the distance; the number of triangle pairs that are looked at
// and kept must not.
TEST(NicheExtent, CostsNoMoreForBodiesFarApart) {
  const SurfaceMesh plate = test::halvedEdges(
      test::halvedEdges(test::halvedEdges(test::halvedEdges(test::makeCuboid({0, 0, 0}, {1, 1, 0.1})))));
  const Body a = makeBody(plate);
  for (const double distance : {1.0, 1e4, 1e6, 3e6, 1e7, 1e9}) {
    SCOPED_TRACE(distance);
    const Isometry3d pose = test::translation({0.0, 0.0, distance});
    const WitnessPair start = certifiedWitness(a, a, pose);
    ExtentWorkspace workspace;
    const NicheExtent extent = measureExtent(*a, *a, pose, start, 2e-9, 256, workspace);
    EXPECT_LE(workspace.open.size(), 257U);
    EXPECT_LE(workspace.seen.size(), 257U);
    if (distance >= 1e7) {
      EXPECT_EQ(extent.kind, NicheKind::Point) << "no longer than twice the tolerance";
    }
    if (distance <= 1e4) {
      EXPECT_EQ(extent.kind, NicheKind::Patch);
    }
  }
}

}  // namespace
}  // namespace concave_distance::niche_extent_test
