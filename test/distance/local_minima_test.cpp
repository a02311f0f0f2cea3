#include "concave_distance/distance/local_minima.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/body_pairs.h"
#include "support/brute_force_minima.h"
#include "support/thesis_scenes.h"

namespace concave_distance {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test::makeBody;
using Body = std::shared_ptr<const BodyMesh>;

/// Scenes here have coordinates up to a few metres: kernel and oracle differ by less than that.
constexpr double kRounding = 1e-12;

LocalMinima minimaOf(const Body& a, const Body& b, const Isometry3d& pose,
                     const LocalMinimaRequest& request) {
  const NormalSides sides = request.through_material ? NormalSides::Both : NormalSides::Outside;
  return findLocalMinima(MinimaIndex(*a, sides), MinimaIndex(*b, sides), pose, request);
}

/// All minima, dark side included, against brute force: one for one, with the same prominence.
void expectSameAsBruteForce(const Body& a, const Body& b, const Isometry3d& pose, double cutoff,
                            double least_prominence) {
  LocalMinimaRequest request;
  request.cutoff = cutoff;
  request.least_prominence = least_prominence;
  request.prominence_limit = std::numeric_limits<double>::infinity();
  request.through_material = true;
  const LocalMinima found = minimaOf(a, b, pose, request);
  const auto truth = test::bruteForceMinima(*a, *b, pose, cutoff, least_prominence, 10.0 * kRounding);
  EXPECT_EQ(found.cost.met_by_flood, 0u);
  ASSERT_EQ(found.niches.size(), truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_NEAR(found.niches[i].distance, truth[i].distance, kRounding);
    const double pass = truth[i].distance * (1.0 + truth[i].prominence);
    if (std::isfinite(pass) && pass <= cutoff) {
      EXPECT_NEAR(found.niches[i].distance * (1.0 + found.niches[i].prominence), pass, 10.0 * kRounding);
    }
  }
}

TEST(LocalMinima, AreThoseOfBruteForceForConcaveShapesAtRandomPoses) {
  RandomEngine engine(3);
  for (std::uint32_t run = 0; run < 200; ++run) {
    SCOPED_TRACE("run " + std::to_string(run));
    const Body a = makeBody(test::concaveShape(uniformIndex(engine, 6)));
    const Body b = makeBody(test::concaveShape(uniformIndex(engine, 6)));
    const Isometry3d pose = test::randomPose(engine, 1.2);
    expectSameAsBruteForce(a, b, pose, 0.6, run % 2 == 0 ? 0.0 : 1e-2);
    if (::testing::Test::HasFailure()) break;
  }
}

TEST(LocalMinima, OfTheBatteryInItsFixtureAreNineOutwards) {
  const test::ThesisScene s = test::loadThesisScene("battery_static", 1.0);
  const LocalMinima found = minimaOf(s.a, s.b, s.a_from_b, LocalMinimaRequest{});
  const double table[] = {0.0757, 0.1336, 0.1499, 0.2039, 0.2953, 0.2971, 0.3731, 0.3938, 0.4026};
  ASSERT_EQ(found.niches.size(), std::size(table));
  for (std::size_t i = 0; i < std::size(table); ++i) {
    // The table's are distances between nodes: not below those of the surfaces.
    EXPECT_LE(found.niches[i].distance, table[i] + 1e-4);
    EXPECT_GT(found.niches[i].distance, 0.98 * table[i]);
    EXPECT_EQ(found.niches[i].outward, Outwardness::Outward);
    EXPECT_GE(found.niches[i].prominence, 1e-2);
  }
  EXPECT_EQ(found.cost.met_by_flood, 0u);
}

}  // namespace
}  // namespace concave_distance
