#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "concave_distance/mesh/repair/repair_mesh.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "support/body_pairs.h"
#include "support/case_seed.h"
#include "support/painted_boxes.h"

/// Queries between unions of solids as files hold them: penetrating exactly where the unions overlap, and
/// else the distance of the unions; at every level, in both orders, cold and warm.
namespace concave_distance::union_of_solids_query_test {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test::Box;
using test::PaintedBoxes;
using Body = std::shared_ptr<const BodyMesh>;

/// Poses of one way through a union.
constexpr std::uint64_t kSteps = 41;

struct Level {
  AccuracyLevel accuracy;
  bool with_niches;
};

constexpr Level kLevels[] = {{AccuracyLevel::Nodes, true},
                             {AccuracyLevel::Refined, true},
                             {AccuracyLevel::Certified, true},
                             {AccuracyLevel::Certified, false}};

TrackerParameters parametersOf(const Level& level) {
  TrackerParameters parameters;
  parameters.accuracy = level.accuracy;
  parameters.niches_wanted = level.with_niches;
  return parameters;
}

/// A body in a frame of its own.
struct Placed {
  PaintedBoxes painted;
  Isometry3d pose;
  Body body;
};

Placed place(PaintedBoxes painted, double scale, RandomEngine& engine) {
  Placed placed{std::move(painted), Isometry3d::Identity(), nullptr};
  if (uniformIndex(engine, 4) != 0) placed.pose = test::randomPose(engine, 5.0 * scale);
  const TriangleSoup soup = test::rewritten(placed.painted.soup, placed.pose, scale, engine);
  placed.body = test::makeBody(repairMesh(soup, {}, "union").mesh);
  return placed;
}

/// Small, so that it fits into cavities, or large and hollow, so that it may go around; or any union.
PaintedBoxes randomPartner(RandomEngine& engine) {
  PaintedBoxes painted;
  const std::uint32_t kind = uniformIndex(engine, 4);
  if (kind == 0) return test::randomUnion(engine);
  const double reach = kind == 1 ? 8.0 : test::uniformIn(engine, 0.05, 0.4);
  const Vector3d at = kind == 1 ? Vector3d(0.3, 0.2, 0.1) : test::uniformInCube(engine, 2.0);
  const Box box(at - Vector3d::Constant(reach), at + reach * Vector3d(1.0, 0.9, 1.1));
  test::addBox(painted.soup, box, uniformIndex(engine, 64), false);
  painted.layers.push_back({box, true});
  if (kind != 1) return painted;
  const Box inner(at - Vector3d::Constant(5.0), at + Vector3d::Constant(5.0));
  test::addBox(painted.soup, inner, uniformIndex(engine, 64), true);
  painted.layers.push_back({inner, false});
  return painted;
}

struct Case {
  Placed a;
  Placed b;
  test::PaintedTruth truth;
  double scale;
};

Case drawCase(std::uint64_t seed, std::uint64_t number) {
  RandomEngine engine(streamSeed(seed, "queries of unions", number));
  PaintedBoxes a = test::randomUnion(engine);
  PaintedBoxes b = randomPartner(engine);
  // Nearly flush faces are a matter of roundings.
  while (test::leastPlaneDifference(a, b) < 1e-6) b = randomPartner(engine);
  const test::PaintedTruth truth = test::truthOf(a, b);
  const double scale = std::pow(10.0, test::uniformIn(engine, -3.0, 3.0));
  Placed placed_a = place(std::move(a), scale, engine);
  Placed placed_b = place(std::move(b), scale, engine);
  return {std::move(placed_a), std::move(placed_b), truth, scale};
}

void expectTruth(const PairSolution& solution, const Level& level, const test::PaintedTruth& truth,
                 double scale) {
  if (truth.overlap) {
    // Without a proof a crossing of the surfaces may be missed, a body within the other not.
    if (!provesDistance(level.accuracy) && !truth.swallowed && solution.status == SolveStatus::Ok) return;
    EXPECT_EQ(solution.status, SolveStatus::Penetrating);
    EXPECT_EQ(solution.distance, 0.0);
    return;
  }
  EXPECT_EQ(solution.status, SolveStatus::Ok);
  const double tolerance = 1e-11 * scale;
  const double expected = truth.distance * scale;
  EXPECT_GE(solution.distance, expected - tolerance);
  if (!provesDistance(level.accuracy)) return;
  EXPECT_LE(solution.distance, expected + tolerance);
  EXPECT_LE(solution.lower_bound, expected);
  EXPECT_GE(solution.lower_bound, expected - tolerance);
}

TEST(QueriesOfUnions, ArePenetratingExactlyWhereTheSolidsOverlap) {
  const std::uint64_t seed = test::caseSeed(1);
  const std::uint64_t cases = test::caseCount<std::uint64_t>(150);
  std::size_t overlaps = 0;
  for (std::uint64_t i = 0; i < cases; ++i) {
    const Case c = drawCase(seed, i);
    overlaps += c.truth.overlap ? 1U : 0U;
    const Isometry3d a_from_b = c.a.pose * c.b.pose.inverse(Eigen::Isometry);
    for (const Level& level : kLevels) {
      SCOPED_TRACE("case " + std::to_string(i) + " of seed " + std::to_string(seed) + ", level " +
                   std::to_string(static_cast<int>(level.accuracy)) +
                   (level.with_niches ? " with niches" : ""));
      const TrackerParameters parameters = parametersOf(level);
      expectTruth(solveOnce("pair", c.a.body, c.b.body, parameters, a_from_b), level, c.truth, c.scale);
      expectTruth(solveOnce("pair", c.b.body, c.a.body, parameters, a_from_b.inverse(Eigen::Isometry)), level,
                  c.truth, c.scale);
      if (testing::Test::HasFailure()) return;
    }
  }
  EXPECT_GT(overlaps, cases / 8);
  EXPECT_LT(overlaps, cases);
}

TEST(QueriesOfUnions, StayRightWhileABodyMovesThrough) {
  const std::uint64_t seed = test::caseSeed(1);
  const std::uint64_t cases = test::caseCount<std::uint64_t>(12 * kSteps) / kSteps;  // a case is a pose
  for (std::uint64_t i = 0; i < cases; ++i) {
    RandomEngine engine(streamSeed(seed, "a way through a union", i));
    const PaintedBoxes stack = test::randomUnion(engine);
    PaintedBoxes cube;
    const Box box(Vector3d::Constant(-0.06), Vector3d::Constant(0.05));
    test::addBox(cube.soup, box, 0, false);
    cube.layers.push_back({box, true});
    const Placed a = place(stack, 1.0, engine);
    const Placed b = place(cube, 1.0, engine);
    const Vector3d from = test::uniformInCube(engine, 2.0);
    const Vector3d to = -from + test::uniformInCube(engine, 0.5);
    for (const Level& level : kLevels) {
      PairTracker tracker("way", a.body, b.body, parametersOf(level));
      PairSolution solution;
      for (std::uint64_t step = 0; step < kSteps; ++step) {
        const Vector3d shift = from + (static_cast<double>(step) / (kSteps - 1.0) + 1e-4) * (to - from);
        PaintedBoxes moved = cube;
        moved.layers.front().box.translate(shift);
        if (test::leastPlaneDifference(stack, moved) < 1e-6) continue;
        const Isometry3d pose = a.pose * test::translation(shift) * b.pose.inverse(Eigen::Isometry);
        tracker.update(pose, 0.01 * static_cast<double>(step), solution);
        SCOPED_TRACE("case " + std::to_string(i) + " of seed " + std::to_string(seed) + ", step " +
                     std::to_string(step) + ", level " + std::to_string(static_cast<int>(level.accuracy)) +
                     (level.with_niches ? " with niches" : ""));
        expectTruth(solution, level, test::truthOf(stack, moved), 1.0);
        if (testing::Test::HasFailure()) return;
      }
    }
  }
}

}  // namespace
}  // namespace concave_distance::union_of_solids_query_test
