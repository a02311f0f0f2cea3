// Unions of convex solids, which have their niches from each two of their solids.
#include "mesh/convex_shells.h"

#include <gtest/gtest.h>

#include "concave_distance/mesh/surface/primitives.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "distance/niches/convex_shell_pairs.h"
#include "support/body_pairs.h"
#include "support/concave_shapes.h"

namespace concave_distance::convex_shells_test {
namespace {

using Outcome = detail::ConvexShellPairs::Outcome;

std::shared_ptr<const BodyMesh> bodyOf(const SurfaceMesh& surface) {
  return std::make_shared<const BodyMesh>("body", surface);
}

/// A rod with a ball around each end.
SurfaceMesh pill(double rod_radius) {
  const SurfaceMesh ball = makeSphere(0.5, 0.01);
  const SurfaceMesh rod = makeCylinder(rod_radius, 2.0, 0.01);
  return test::makeJoined(test::makeJoined(rod, ball, {0.0, 0.0, 1.0}), ball, {0.0, 0.0, -1.0});
}

SurfaceMesh twoBoxes(const Eigen::Vector3d& offset) {
  return test::makeJoined(makeBox({1.0, 1.0, 1.0}), makeBox({1.0, 1.0, 1.0}), offset);
}

TEST(ConvexShells, OfPrimitivesThatCrossEachIsOne) {
  const auto body = bodyOf(pill(0.4));
  const std::vector<ConvexShells::Shell>& shells = body->convexShells().shells;
  ASSERT_EQ(shells.size(), 3U);
  std::size_t triangles = 0;
  for (const ConvexShells::Shell& shell : shells) {
    ASSERT_EQ(shell.triangles.size(), shell.mesh->surface().triangleCount());
    for (std::size_t t = 0; t < shell.triangles.size(); ++t) {
      for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(shell.mesh->surface().corner(TriangleIndex{t}, k),
                  body->surface().corner(shell.triangles[t], k));
      }
    }
    triangles += shell.triangles.size();
  }
  EXPECT_EQ(triangles, body->surface().triangleCount());
}

TEST(ConvexShells, ABallMayHaveTheRadiusOfTheRod) {
  EXPECT_GE(bodyOf(pill(0.5))->convexShells().shells.size(), 3U);
}

TEST(ConvexShells, BoxesThatShareAnEdgeAreTwo) {
  EXPECT_EQ(bodyOf(twoBoxes({1.0, 0.0, 1.0}))->convexShells().shells.size(), 2U);
}

TEST(ConvexShells, AreNoneWhereOneSolidIsNotConvexOrOpen) {
  EXPECT_TRUE(bodyOf(test::makeComb(3))->convexShells().shells.empty());
  EXPECT_TRUE(bodyOf(test::makeJoined(makeBox({1.0, 1.0, 1.0}), test::makeLShape(), {0.3, 0.0, 0.0}))
                  ->convexShells()
                  .shells.empty());
  EXPECT_TRUE(bodyOf(test::makeSheet(3, 3))->convexShells().shells.empty());
}

class ConvexShellPairsTest : public ::testing::Test {
 protected:
  Outcome collect(const SurfaceMesh& a, const SurfaceMesh& b, const Eigen::Isometry3d& pose) {
    const auto body_a = bodyOf(a);
    const auto body_b = bodyOf(b);
    candidates.clear();
    WorkLimit none;
    detail::ConvexShellPairs pairs;
    return pairs.collect(detail::PairFrame::withFacets(*body_a, *body_b, pose), request, candidates, none);
  }
  LocalMinimaRequest visible() const {
    LocalMinimaRequest wanted;
    wanted.hidden = false;
    wanted.rule.least_prominence = 1e-2;
    return wanted;
  }

  LocalMinimaRequest request = visible();
  std::vector<MinimumCandidate> candidates;
};

TEST_F(ConvexShellPairsTest, GiveOneCandidateForEachPairThatIsApart) {
  const Eigen::AngleAxisd turn(0.4, Eigen::Vector3d(1.0, 2.0, 3.0).normalized());
  Eigen::Isometry3d pose(Eigen::Translation3d(2.5, 0.3, 0.2) * turn);
  EXPECT_EQ(collect(twoBoxes({0.2, 0.6, 0.7}), makeBox({0.5, 0.5, 0.5}), pose), Outcome::Complete);
  EXPECT_GE(candidates.size(), 1U);
  EXPECT_LE(candidates.size(), 2U);
}

TEST_F(ConvexShellPairsTest, LeaveHiddenNichesAndOtherBodiesToTheCones) {
  const Eigen::Isometry3d pose(Eigen::Translation3d(3.0, 0.3, 0.2));
  EXPECT_EQ(collect(test::makeComb(3), makeBox({0.5, 0.5, 0.5}), pose), Outcome::Unknown);
  request.hidden = true;
  EXPECT_EQ(collect(twoBoxes({0.2, 0.6, 0.7}), makeBox({0.5, 0.5, 0.5}), pose), Outcome::Unknown);
  EXPECT_TRUE(candidates.empty());
}

// The lower box ends in the upper one's material; its closest edge to the plate goes on outside.
TEST_F(ConvexShellPairsTest, ASetThatBeginsInAnotherShellIsLeftToTheConesOrShown) {
  const SurfaceMesh bar =
      test::makeJoined(makeBox({2.0, 0.2, 0.2}), makeBox({0.4, 0.4, 0.4}), {1.0, 0.0, 0.0});
  const Eigen::Isometry3d pose(Eigen::Translation3d(0.0, 0.0, -0.5));
  TrackerParameters parameters;
  const PairSolution solution =
      solveOnce("bar", bodyOf(bar), bodyOf(makeBox({3.0, 3.0, 0.2})), parameters, pose);
  ASSERT_TRUE(solution.niches_complete);
  ASSERT_EQ(solution.niches.size(), 1U) << "the bar is 0.1 higher than the block and beside it";
  EXPECT_NEAR(solution.niches[0].distance, 0.2, 1e-12);
}

}  // namespace
}  // namespace concave_distance::convex_shells_test
