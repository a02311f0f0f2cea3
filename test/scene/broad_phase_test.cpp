#include "concave_distance/scene/broad_phase.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "base/constants.h"
#include "base/random_engine.h"

namespace concave_distance::broad_phase_test {
namespace {

BodyBounds box(const Eigen::Vector3d& half_extents, const Eigen::Vector3d& centre = {0, 0, 0}) {
  return {centre, half_extents, half_extents.norm()};
}

Eigen::Isometry3d pose(const Eigen::Vector3d& translation,
                       const Eigen::AngleAxisd& rotation = {0.0, Eigen::Vector3d::UnitX()}) {
  Eigen::Isometry3d isometry = Eigen::Isometry3d::Identity();
  isometry.translate(translation).rotate(rotation);
  return isometry;
}

// The bound may fall short of the closed form by twice the slack it subtracts, for lengths up to 10 m.
constexpr double kSlack = 2.0 * 64.0 * 1.2e-16 * 100.0;

TEST(BroadPhase, ParallelBoxesGiveTheExactDistanceOfFacesEdgesAndCorners) {
  const BodyBounds a = box({1, 2, 3});
  const BodyBounds b = box({0.5, 0.5, 0.5});
  EXPECT_NEAR(distanceLowerBound(a, b, pose({2, 0, 0})), 0.5, kSlack);
  EXPECT_NEAR(distanceLowerBound(a, b, pose({1.5 + 3, 2.5 + 4, 0})), 5.0, kSlack);
  EXPECT_NEAR(distanceLowerBound(a, b, pose({-1.5 - 2, 2.5 + 3, 3.5 + 6})), 7.0, kSlack);
}

TEST(BroadPhase, QuarterTurnsChangeNothing) {
  const BodyBounds a = box({1, 2, 3});
  const BodyBounds b = box({0.5, 0.25, 0.125});
  const Eigen::AngleAxisd turn(kPi / 2, Eigen::Vector3d::UnitZ());
  EXPECT_NEAR(distanceLowerBound(a, b, pose({1.25 + 3, 2.5 + 4, 0}, turn)), 5.0, kSlack);
}

TEST(BroadPhase, EdgeTowardsFaceIsExact) {
  const BodyBounds a = box({1, 1, 1});
  const BodyBounds b = box({1, 1, 1});
  const Eigen::AngleAxisd turn(kPi / 4, Eigen::Vector3d::UnitZ());
  EXPECT_NEAR(distanceLowerBound(a, b, pose({4, 0, 0}, turn)), 3.0 - std::sqrt(2.0), kSlack);
  EXPECT_NEAR(distanceLowerBound(b, a, pose({4, 0, 0}, turn).inverse()), 3.0 - std::sqrt(2.0), kSlack);
}

TEST(BroadPhase, CrossingEdgesAreExactAlongTheirCommonNormal) {
  // Two cubes stand on edges that cross at right angles: the gap lies along the edges' cross product only.
  const BodyBounds a = box({1, 1, 1});
  Eigen::Isometry3d world_from_a = pose({0, 0, 0}, {kPi / 4, Eigen::Vector3d::UnitX()});
  Eigen::Isometry3d world_from_b = pose({0, 0, 3}, {kPi / 4, Eigen::Vector3d::UnitY()});
  EXPECT_NEAR(distanceLowerBound(a, a, world_from_a.inverse() * world_from_b), 3.0 - 2.0 * std::sqrt(2.0),
              kSlack);
}

TEST(BroadPhase, SpheresServeWhereTheyAreTighterThanBoxes) {
  BodyBounds ball = box({1, 1, 1});
  ball.radius = 1.0;
  const Eigen::Vector3d diagonal = Eigen::Vector3d(1, 1, 1).normalized();
  EXPECT_NEAR(distanceLowerBound(ball, ball, pose(5.0 * diagonal)), 3.0, kSlack);
}

TEST(BroadPhase, CentresOffTheFramesOriginAreTransformed) {
  const BodyBounds a = box({1, 1, 1}, {10, 0, 0});
  const BodyBounds b = box({1, 1, 1}, {0, 10, 0});
  const Eigen::AngleAxisd turn(-kPi / 2, Eigen::Vector3d::UnitZ());  // b's centre comes to (10, 0, 0)
  EXPECT_NEAR(distanceLowerBound(a, b, pose({0, 0, 5}, turn)), 3.0, 10 * kSlack);
}

TEST(BroadPhase, BoundsThatMeetProveNothing) {
  const BodyBounds a = box({1, 1, 1});
  EXPECT_EQ(distanceLowerBound(a, a, pose({2, 0, 0})), 0.0);
  EXPECT_EQ(distanceLowerBound(a, a, pose({0, 0, 0})), 0.0);
}

TEST(BroadPhase, PoseThatIsNotFiniteProvesNothing) {
  const BodyBounds a = box({1, 1, 1});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(distanceLowerBound(a, a, pose({nan, 0, 0})), 0.0);
  EXPECT_EQ(distanceLowerBound(a, a, pose({infinity, 0, 0})), 0.0);
  Eigen::Isometry3d broken = pose({9, 0, 0});
  broken.linear()(1, 2) = nan;
  EXPECT_EQ(distanceLowerBound(a, a, broken), 0.0);
}

TEST(BroadPhase, BoundsOfASurfaceHoldItsVertices) {
  const SurfaceMesh surface({{0.1, 0, 0}, {3.3, 0, 0}, {0, 2, 0.7}},
                            {{NodeIndex{0}, NodeIndex{1}, NodeIndex{2}}}, "triangle");
  const BodyBounds bounds = boundsOf(surface);
  for (const Eigen::Vector3d& vertex : surface.vertices()) {
    const Eigen::Vector3d offset = vertex - bounds.centre;
    EXPECT_TRUE((offset.cwiseAbs().array() <= bounds.half_extents.array()).all());
    EXPECT_LE(offset.norm(), bounds.radius);
  }
  EXPECT_NEAR(bounds.half_extents.x(), 1.65, 1e-15);
  // Ten roundings up of a number below 2.
  EXPECT_NEAR(bounds.radius, Eigen::Vector3d(1.65, 1.0, 0.35).norm(), 10 * 2.3e-16);
}

double uniform(RandomEngine& engine, double low, double high) {
  return low + (high - low) * uniformUnit(engine);
}

Eigen::Vector3d uniformVector(RandomEngine& engine, double low, double high) {
  return {uniform(engine, low, high), uniform(engine, low, high), uniform(engine, low, high)};
}

Eigen::Vector3d nearestIn(const BodyBounds& bounds, const Eigen::Vector3d& point) {
  const Eigen::Vector3d offset = point - bounds.centre;
  return bounds.centre + offset.cwiseMax(-bounds.half_extents).cwiseMin(bounds.half_extents);
}

// Distance of two points of the two boxes, found by alternating projections (Cheney and Goldstein 1959):
// never below the boxes' distance, and converging to it.
double projectedDistance(const BodyBounds& a, const BodyBounds& b, const Eigen::Isometry3d& a_from_b) {
  const Eigen::Isometry3d b_from_a = a_from_b.inverse();
  Eigen::Vector3d on_a = a.centre;
  Eigen::Vector3d on_b = b.centre;
  for (int i = 0; i < 300; ++i) {
    on_b = nearestIn(b, b_from_a * on_a);
    on_a = nearestIn(a, a_from_b * on_b);
  }
  return (on_a - a_from_b * on_b).norm();
}

struct RandomCase {
  explicit RandomCase(std::uint64_t seed) {
    RandomEngine engine(seed);
    const double size = std::pow(10.0, uniform(engine, -3.0, 3.0));
    a = box(size * uniformVector(engine, 0, 1), size * uniformVector(engine, -1, 1));
    b = box(size * uniformVector(engine, 0, 1), size * uniformVector(engine, -1, 1));
    const Eigen::Quaterniond q(uniform(engine, -1, 1), uniform(engine, -1, 1), uniform(engine, -1, 1),
                               uniform(engine, -1, 1));
    a_from_b = pose(size * uniformVector(engine, -4, 4), Eigen::AngleAxisd(q.normalized()));
  }
  BodyBounds a;
  BodyBounds b;
  Eigen::Isometry3d a_from_b;
};

RC_GTEST_PROP(BroadPhase, NeverExceedsTheDistanceOfTwoPointsOfTheBoxes, (std::uint64_t seed)) {
  const RandomCase random(seed);
  const double bound = distanceLowerBound(random.a, random.b, random.a_from_b);
  RC_ASSERT(bound >= 0.0);
  RC_ASSERT(bound <= projectedDistance(random.a, random.b, random.a_from_b));
}

RC_GTEST_PROP(BroadPhase, SwappingTheBodiesKeepsTheBoundWithinItsSlack, (std::uint64_t seed)) {
  const RandomCase random(seed);
  const double forward = distanceLowerBound(random.a, random.b, random.a_from_b);
  const double backward = distanceLowerBound(random.b, random.a, random.a_from_b.inverse(Eigen::Isometry));
  // Both lose at most the slack divided by the shortest cross product that is tried.
  const double size = random.a.radius + random.b.radius + random.a_from_b.translation().norm() +
                      random.a.centre.norm() + random.b.centre.norm();
  RC_ASSERT(std::abs(forward - backward) <= 64.0 * 2.2e-16 * 10.0 * size / 1e-3);
}

RC_GTEST_PROP(BroadPhase, APoseThatShrinksOrStretchesALittleIsTakenAsItIs, (std::uint64_t seed)) {
  RandomCase random(seed);
  RandomEngine engine(seed + 1);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) random.a_from_b.linear()(i, j) += uniform(engine, -1e-3, 1e-3);
  }
  // Sampled points of b under the very matrix given.
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d in_b =
        random.b.centre + random.b.half_extents.cwiseProduct(uniformVector(engine, -1, 1).cwiseSign());
    const Eigen::Vector3d in_a = random.a_from_b * in_b;
    RC_ASSERT(distanceLowerBound(random.a, random.b, random.a_from_b) <=
              (nearestIn(random.a, in_a) - in_a).norm());
  }
}

}  // namespace
}  // namespace concave_distance::broad_phase_test
