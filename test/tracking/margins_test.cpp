// Bodies with margins: the answer is that of the surfaces moved out by a ball that is swept along them.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <string>

#include "concave_distance/base/error.h"
#include "concave_distance/tracking/pair_effects.h"
#include "concave_distance/tracking/pair_tracker.h"
#include "support/body_pairs.h"
#include "support/count_allocations.h"
#include "support/round_bodies.h"
#include "support/solution_bytes.h"

namespace concave_distance::margins_test {
namespace {

using namespace test;
using Body = std::shared_ptr<const BodyMesh>;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kRounding = 1e-12;

TrackerParameters withMargins(double a, double b) {
  TrackerParameters parameters;
  parameters.margin_a = a;
  parameters.margin_b = b;
  return parameters;
}

Body cube() {
  return makeBody(makeCuboid(Vector3d::Constant(-0.5), Vector3d::Constant(0.5)));
}

PairSolution cubesApartBy(double gap, const TrackerParameters& parameters) {
  return solveOnce("cubes", cube(), cube(), parameters, translation({1.0 + gap, 0.1, 0.0}));
}

TEST(Margins, TakeTheirSumFromTheDistanceAndMoveThePointsAlongTheSegment) {
  for (const AccuracyLevel level : {AccuracyLevel::Certified, AccuracyLevel::Refined, AccuracyLevel::Nodes}) {
    TrackerParameters parameters = withMargins(0.1, 0.25);
    parameters.accuracy = level;
    const PairSolution found = cubesApartBy(0.5, parameters);
    EXPECT_EQ(found.status, SolveStatus::Ok);
    // Between nodes, the shortest segment is not along the gap.
    const double bare = cubesApartBy(0.5,
                                     [&] {
                                       TrackerParameters without = parameters;
                                       without.margin_a = without.margin_b = 0.0;
                                       return without;
                                     }())
                            .distance;
    EXPECT_NEAR(found.distance, bare - 0.35, kRounding);
    EXPECT_EQ(found.signed_distance, found.distance);
    EXPECT_NEAR((found.point_b_in_a - found.point_a_in_a).norm(), found.distance, kRounding);
    ASSERT_FALSE(found.niches.empty());
    EXPECT_EQ(found.niches.front().distance, found.distance);
    EXPECT_NEAR((found.niches.front().point_b_in_a - found.niches.front().point_a_in_a).norm(),
                found.distance, kRounding);
    if (level == AccuracyLevel::Nodes) continue;
    EXPECT_NEAR(found.distance, 0.15, kRounding);
    EXPECT_NEAR(found.point_a_in_a.x(), 0.6, kRounding);
    EXPECT_NEAR(found.point_b_in_a.x(), 0.75, kRounding);
    if (level != AccuracyLevel::Certified) continue;
    EXPECT_LE(found.lower_bound, 0.15);
    EXPECT_NEAR(found.lower_bound, 0.15, kRounding);
    EXPECT_TRUE(found.niches_complete);
  }
}

TEST(Margins, ThatOverlapAlonePenetrateByAnExactSignedDistance) {
  for (const bool niches : {true, false}) {
    TrackerParameters parameters = withMargins(0.1, 0.25);
    parameters.niches_wanted = niches;
    const PairSolution found = cubesApartBy(0.2, parameters);
    EXPECT_EQ(found.status, SolveStatus::Penetrating);
    EXPECT_EQ(found.distance, 0.0);
    EXPECT_EQ(found.lower_bound, 0.0);
    EXPECT_NEAR(found.signed_distance, -0.15, kRounding);
    EXPECT_FALSE(found.meeting_triangles);
    EXPECT_TRUE(std::isnan(found.surface_distance));
    EXPECT_NEAR(found.point_a_in_a.x(), 0.6, kRounding);
    EXPECT_NEAR(found.point_b_in_a.x(), 0.45, kRounding);
    EXPECT_NEAR(found.normal_in_a.x(), 1.0, kRounding);
    if (!niches) continue;
    ASSERT_EQ(found.niches.size(), 1U);
    EXPECT_EQ(found.niches.front().distance, 0.0);
    EXPECT_EQ(found.niches.front().signed_distance, found.signed_distance);
    EXPECT_TRUE(found.niches_complete);
  }
}

TEST(Margins, ChangeNothingElseWhereTheBareBodiesOverlap) {
  const PairSolution bare = cubesApartBy(-0.2, {});
  const PairSolution found = cubesApartBy(-0.2, withMargins(0.1, 0.25));
  EXPECT_EQ(found.status, SolveStatus::Penetrating);
  EXPECT_EQ(found.distance, 0.0);
  EXPECT_TRUE(std::isnan(found.signed_distance));
  EXPECT_TRUE(found.meeting_triangles);
  ASSERT_EQ(found.niches.size(), 1U);
  EXPECT_TRUE(std::isnan(found.niches.front().signed_distance));
  Bytes bytes_of_bare;
  Bytes bytes;
  appendSolution(bare, bytes_of_bare);
  appendSolution(found, bytes);
  EXPECT_EQ(bytes_of_bare, bytes);
}

TEST(Margins, ASwallowedBodyKeepsTheDistanceOfTheSurfaces) {
  const Body small = makeBody(makeCuboid(Vector3d::Constant(-0.1), Vector3d::Constant(0.1)));
  const PairSolution found =
      solveOnce("inside", cube(), small, withMargins(0.05, 0.0), translation({0.1, 0, 0}));
  EXPECT_EQ(found.status, SolveStatus::Penetrating);
  EXPECT_NEAR(found.surface_distance, 0.3, kRounding);
  EXPECT_TRUE(std::isnan(found.signed_distance));
}

TEST(Margins, CutoffAndToleranceCountForThePaddedDistance) {
  TrackerParameters parameters = withMargins(0.1, 0.2);
  parameters.cutoff = 0.2;
  EXPECT_EQ(cubesApartBy(0.49, parameters).niches.size(), 1U);
  const PairSolution beyond = cubesApartBy(0.51, parameters);
  EXPECT_TRUE(beyond.niches.empty());
  EXPECT_TRUE(beyond.niches_complete);
  parameters.relative_tolerance = 0.5;
  RandomEngine engine(41);
  const Body a = makeBody(makeHook());
  const Body b = makeBody(makeStairs(4));
  for (int run = 0; run < 50; ++run) {
    const PairSolution found = solveOnce("tolerance", a, b, parameters, randomPose(engine, 2.0));
    if (found.status == SolveStatus::Penetrating) continue;
    EXPECT_GE(found.lower_bound, 0.5 * found.distance - kRounding) << "run " << run;
  }
}

// A ball in an inner corner: its two niches are one as soon as margins reach over the pass between them.
TEST(Margins, PlacesWithinThemAreOneNicheWhereTheyAreConnected) {
  const Body corner = makeBody(makeLShape(0.6, 0.15, 0.2));  // the inner faces are at x = 0.15 and y = 0.15
  const Body box = makeBody(makeCuboid(Vector3d::Constant(-0.05), Vector3d::Constant(0.05)));
  const Isometry3d pose = translation({0.28, 0.30, 0.1});
  TrackerParameters parameters;
  parameters.prominence_limit = std::numeric_limits<double>::infinity();
  const PairSolution bare = solveOnce("corner", corner, box, parameters, pose);
  ASSERT_EQ(bare.niches.size(), 2U);
  const double deep = bare.niches[0].distance;
  const double shallow = bare.niches[1].distance;
  const double pass = shallow * (1.0 + bare.niches[1].prominence);
  ASSERT_NEAR(deep, 0.08, kRounding);
  ASSERT_NEAR(shallow, 0.10, kRounding);
  ASSERT_GT(pass, 0.11);
  for (const double margin : {0.01, 0.05, 0.09, 0.105, 0.5 * (0.1 + pass), pass - 1e-9, pass + 1e-9, 0.15}) {
    parameters.margin_a = 0.25 * margin;
    parameters.margin_b = 0.75 * margin;
    const PairSolution found = solveOnce("corner", corner, box, parameters, pose);
    EXPECT_EQ(found.niches.size(), margin < pass ? 2U : 1U) << margin;
    EXPECT_TRUE(found.niches_complete);
    EXPECT_NEAR(found.niches.front().signed_distance, deep - margin, kRounding);
    if (found.niches.size() < 2) continue;
    EXPECT_NEAR(found.niches[1].signed_distance, shallow - margin, kRounding);
    EXPECT_EQ(found.niches[1].distance, std::max(0.0, found.niches[1].signed_distance));
    if (margin < shallow) {
      EXPECT_NEAR(found.niches[1].prominence, (pass - margin) / (shallow - margin) - 1.0, 1e-9) << margin;
    } else {
      EXPECT_TRUE(std::isnan(found.niches[1].prominence));
    }
  }
}

// A ripple of the bare distance rises by more than the least prominence of a small padded one.
TEST(Margins, MakeNichesOfRipplesWhereThePaddedGapIsSmall) {
  const Body a = makeBody(makeStairs(4));
  const Body b = makeBody(makeComb(3));
  RandomEngine engine(5);
  std::size_t more = 0;
  for (int run = 0; run < 30; ++run) {
    const Isometry3d pose = randomPose(engine, 1.5);
    TrackerParameters parameters;
    parameters.least_prominence = 0.2;
    const PairSolution bare = solveOnce("pair", a, b, parameters, pose);
    if (bare.status != SolveStatus::Ok) continue;
    parameters.margin_a = 0.99 * bare.distance;
    const PairSolution found = solveOnce("pair", a, b, parameters, pose);
    EXPECT_GE(found.niches.size(), bare.niches.size()) << "run " << run;
    more += found.niches.size() > bare.niches.size() ? 1 : 0;
  }
  EXPECT_GT(more, 0U);
}

TEST(Margins, OfSpheresGiveTheDistanceOfLargerSpheres) {
  const Body large = makeRoundBody(sphereOf(0.5));
  const Body small = makeRoundBody(sphereOf(0.2));
  const Body as_mesh = makeRoundBody(sphereOf(0.5), false);
  const Body other_mesh = makeRoundBody(sphereOf(0.2), false);
  for (const double gap : {1.0, 0.31, 0.3, 0.1, 1e-6}) {
    const Isometry3d pose = translation(Vector3d(0.6, 0.48, 0.64).normalized() * (0.7 + gap));
    const TrackerParameters parameters = withMargins(0.1, 0.2);
    const PairSolution exact = solveOnce("spheres", large, small, parameters, pose);
    EXPECT_NEAR(exact.signed_distance, gap - 0.3, kRounding);
    EXPECT_EQ(exact.status, exact.signed_distance > 0.0 ? SolveStatus::Ok : SolveStatus::Penetrating);
    EXPECT_EQ(exact.niches.size(), 1U);
    EXPECT_TRUE(exact.niches_complete);
    const PairSolution meshes = solveOnce("meshes", as_mesh, other_mesh, parameters, pose);
    EXPECT_GE(meshes.signed_distance, gap - 0.3 - kRounding);
    EXPECT_LE(meshes.signed_distance, gap - 0.3 + 0.007);  // the chord errors
    EXPECT_EQ(meshes.niches.size(), 1U) << gap;
    EXPECT_TRUE(meshes.niches_complete);
  }
}

TEST(Margins, AThinRodWithOneIsACapsule) {
  constexpr double kThin = 1e-7;
  const Body rod = makeBody(makeBox({kThin, kThin, 0.4}));
  const Body capsule = makeRoundBody(roundShape(RoundKind::Capsule, 0.1, 0.2, 1e-3));
  RandomEngine engine(8);
  std::size_t apart = 0;
  for (std::uint32_t run = 0; run < 60; ++run) {
    const Body obstacle = makeBody(concaveShape(run));
    const Isometry3d pose = randomPose(engine, 1.2);
    const PairSolution exact = solveOnce("capsule", obstacle, capsule, {}, pose);
    const PairSolution padded = solveOnce("rod", obstacle, rod, withMargins(0.0, 0.1), pose);
    if (exact.status == SolveStatus::Penetrating) {
      EXPECT_EQ(padded.status, SolveStatus::Penetrating) << "run " << run;
      continue;
    }
    ++apart;
    EXPECT_NEAR(padded.distance, exact.distance, kThin) << "run " << run;
    EXPECT_NEAR((padded.point_a_in_a - exact.point_a_in_a).norm(), 0.0, 1e-3) << "run " << run;
    ASSERT_FALSE(padded.niches.empty());
  }
  EXPECT_GT(apart, 20U);
}

TEST(Margins, ANicheKeepsItsIdWhileMarginsBeginToOverlap) {
  const Body small = makeBody(makeCuboid(Vector3d::Constant(-0.2), Vector3d::Constant(0.2)));
  PairTracker tracker("approach", cube(), small, withMargins(0.2, 0.1));
  PairSolution solution;
  for (int k = 0; k < 60; ++k) {
    tracker.update(turned(0.3, {0.1, 1.0, 0.2}, {1.2 - 0.01 * k, 0.1, 0.0}), 0.01 * k, solution);
    ASSERT_EQ(solution.niches.size(), 1U) << "cycle " << k;
    EXPECT_EQ(solution.niches.front().id, 1U);
    EXPECT_EQ(solution.status, solution.distance > 0.0 ? SolveStatus::Ok : SolveStatus::Penetrating);
    if (k == 0 || std::isnan(solution.signed_distance)) continue;
    EXPECT_NEAR(solution.closing_speed, 1.0, 1e-9) << "cycle " << k;
  }
}

TEST(Margins, TheHalvesOfACycleGiveThePaddedAnswerToo) {
  PairTracker tracker("halves", cube(), cube(), withMargins(0.1, 0.1));
  PairSolution solution;
  const auto far_off = WorkLimit::Clock::now() + std::chrono::hours(1);
  const Isometry3d pose = translation({1.5, 0.0, 0.0});
  ASSERT_TRUE(tracker.prove(pose, 0.0, solution, far_off));
  EXPECT_NEAR(solution.distance, 0.3, kRounding);
  ASSERT_TRUE(tracker.addNiches(solution, far_off));
  EXPECT_NEAR(solution.distance, 0.3, kRounding);
  EXPECT_NEAR(solution.lower_bound, 0.3, kRounding);
  ASSERT_TRUE(tracker.prove(pose, 0.1, solution, far_off));
  tracker.putOffNiches(solution);
  EXPECT_NEAR(solution.distance, 0.3, kRounding);
  ASSERT_EQ(solution.niches.size(), 1U);
  EXPECT_NEAR(solution.niches.front().distance, 0.3, kRounding);
}

TEST(Margins, AWarmCycleWithThemAllocatesNothing) {
  const Body comb = makeBody(makeComb(5));
  PairTracker tracker("combs", comb, comb, withMargins(0.01, 0.02));
  PairSolution solution;
  double time = 0.0;
  const auto run = [&] {
    for (int k = 0; k < 200; ++k) {
      const double t = 2.0 * M_PI * k / 200.0;
      tracker.update(turned(M_PI + 0.01 * std::sin(t), Vector3d::UnitZ(),
                            {1.225 + 0.008 * std::sin(2.0 * t), 0.6 + 0.1 * std::sin(t), 0.02 * std::sin(t)}),
                     time += 0.01, solution);
    }
  };
  for (int round = 0; round < 3; ++round) run();
  const std::size_t before = allocations.load();
  run();
  EXPECT_EQ(allocations.load(), before);
}

TEST(Margins, ForcesFollowTheBareBodies) {
  EffectSettings settings;
  settings.normal_force.emplace();
  const Body a = cube();
  PairEffects effects(a, a, settings, inContact(Material(), Material()));
  PairContacts contacts;
  for (const double gap : {0.1, -0.1}) {
    const PairSolution solution =
        solveOnce("contact", a, a, withMargins(0.2, 0.2), translation({1.0 + gap, 0.1, 0.05}));
    ASSERT_EQ(solution.status, SolveStatus::Penetrating);
    effects.update(solution, RelativeTwist(), 0.0, contacts);
    EXPECT_EQ(contacts.regions.size(), gap > 0.0 ? 0U : 1U);
    if (gap > 0.0) {
      EXPECT_EQ(contacts.on_b_in_a.force, Vector3d::Zero());
    }
  }
}

std::string refusalOf(double a, double b) {
  try {
    withMargins(a, b).validate("pair 'arm/shelf'");
    return "accepted";
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(Margins, ThatAreNegativeOrNotFiniteAreRefused) {
  for (const double wrong :
       {-1e-9, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity()}) {
    for (const bool is_of_b : {false, true}) {
      const std::string message = is_of_b ? refusalOf(0.1, wrong) : refusalOf(wrong, 0.0);
      EXPECT_NE(message.find("arm/shelf"), std::string::npos) << message;
      EXPECT_NE(message.find(is_of_b ? "margin_b" : "margin_a"), std::string::npos) << message;
    }
  }
  EXPECT_EQ(refusalOf(0.0, 10.0), "accepted");
}

}  // namespace
}  // namespace concave_distance::margins_test
