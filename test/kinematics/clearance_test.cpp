#include "concave_distance/kinematics/clearance.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "clearance_fixture.h"
#include "support/robots.h"

namespace concave_distance::clearance_test {
namespace {

using Eigen::Vector3d;
using test::ClearanceTest;
using test::kRounding;

constexpr double kPi = 3.14159265358979323846;

// ---- closed forms ----

/// A ball of 0.1 m on an arm of 1 m that turns about z, past a ball of 0.2 m at a distance from the axis.
class Pendulum : public ClearanceTest {
 protected:
  void hang(double post, const std::string& margin = "", double origin = 0.0) {
    options.descriptions["robot"] =
        test::robot(test::bareLink("base") +
                    "<link name='bob'><collision><origin xyz='1 0 0'/><geometry><sphere radius='0.1'/>"
                    "</geometry></collision></link>" +
                    "<joint name='swing' type='continuous'><parent link='base'/><child link='bob'/>"
                    "<axis xyz='0 0 1'/></joint>");
    const std::string xyz =
        std::to_string(origin + post) + ", " + std::to_string(origin) + ", " + std::to_string(origin);
    use(load(
        "robots:\n  - {description: robot}\nbodies:\n  - {name: post, frame: world, sphere: {radius: 0.2}, "
        "pose: {xyz: [" +
        xyz + "]}" + margin + "}\n"));
    state.robots[0].world_from_link[0].translation().setConstant(origin);
    joints->evaluate(joints->restPositions(), state);
  }
  static double apart(double post, double angle) {
    return std::hypot(std::cos(angle) - post, std::sin(angle)) - 0.3;
  }
};

TEST_F(Pendulum, IsNearestWhereItPassesThePost) {
  hang(1.5);
  for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
    parameters.tolerance = tolerance;
    const ClearanceResult result = clearance(joint("swing", {-1.0, 2.0}));
    EXPECT_EQ(result.status, ClearanceStatus::Ok);
    requireBracket(result, 0.2);
    // Near the minimum the distance grows by 3/2 of the square of the angle, of 3 rad a second.
    EXPECT_NEAR(result.time, 1.0 / 3.0, std::sqrt(tolerance));
    EXPECT_EQ(scene.bodies[result.body_a].name, "bob");
    EXPECT_EQ(scene.bodies[result.body_b].name, "post");
    EXPECT_FALSE(result.first_below.has_value());
  }
}

TEST_F(Pendulum, IsBelowAThresholdFirstWhereTheFormulaSays) {
  hang(1.5);
  parameters.tolerance = 1e-5;
  parameters.threshold = 0.3;
  const ClearanceResult result = clearance(joint("swing", {-1.0, 2.0}));
  ASSERT_TRUE(result.first_below.has_value());
  // cos of the angle at which the centres are 0.6 m apart.
  const double angle = std::acos((1.0 + 1.5 * 1.5 - 0.36) / 3.0);
  const double time = (1.0 - angle) / 3.0;
  EXPECT_LE(result.first_below->proven_until, time);
  EXPECT_GE(result.first_below->time, time);
  EXPECT_LT(result.first_below->time - result.first_below->proven_until, 1e-4);
  EXPECT_EQ(scene.bodies[result.first_below->body_a].name, "bob");
}

TEST_F(Pendulum, IsNeverBelowALesserThreshold) {
  hang(1.5);
  parameters.threshold = 0.15;
  const ClearanceResult result = clearance(joint("swing", {-1.0, 2.0}));
  ASSERT_TRUE(result.first_below.has_value());
  EXPECT_EQ(result.first_below->proven_until, 1.0);
  EXPECT_TRUE(std::isnan(result.first_below->time));
}

TEST_F(Pendulum, TouchesFirstWhereTheFormulaSays) {
  hang(1.2);
  parameters.tolerance = 1e-6;
  const ClearanceResult result = clearance(joint("swing", {-1.0, 2.0}));
  EXPECT_EQ(result.status, ClearanceStatus::Penetrating);
  EXPECT_EQ(result.distance, 0.0);
  EXPECT_EQ(result.lower_bound, 0.0);
  ASSERT_TRUE(result.first_below.has_value());
  const double time = (1.0 - std::acos((1.0 + 1.2 * 1.2 - 0.09) / 2.4)) / 3.0;
  EXPECT_LE(result.first_below->proven_until, time + 1e-12);
  EXPECT_GE(result.first_below->time, time - 1e-12);
  EXPECT_LT(result.first_below->time - result.first_below->proven_until, 1e-5);
}

TEST_F(Pendulum, TakesMarginsOff) {
  hang(1.5, ", margin: 0.15");
  parameters.tolerance = 1e-5;
  requireBracket(clearance(joint("swing", {-1.0, 2.0})), 0.05);
  parameters.threshold = 0.1;
  const ClearanceResult result = clearance(joint("swing", {-1.0, 2.0}));
  const double time = (1.0 - std::acos((1.0 + 1.5 * 1.5 - 0.55 * 0.55) / 3.0)) / 3.0;
  EXPECT_NEAR(result.first_below->time, time, 1e-4);
}

TEST_F(Pendulum, PassesManyTimesInManyTurns) {
  hang(1.5);
  parameters.tolerance = 1e-3;
  const ClearanceResult result = clearance(joint("swing", {-1.0, 100.0 * kPi}));
  EXPECT_EQ(result.status, ClearanceStatus::Ok);
  requireBracket(result, 0.2, 1e-10);
}

TEST_F(Pendulum, HasTheDistanceOfItsPoseWhenItStandsStill) {
  hang(1.5);
  for (const std::vector<double>& positions :
       {std::vector<double>{0.5}, std::vector<double>{0.5, 0.5}, std::vector<double>{0.5, 0.5 + 1e-14}}) {
    const ClearanceResult result = clearance(joint("swing", positions));
    EXPECT_EQ(result.status, ClearanceStatus::Ok);
    EXPECT_NEAR(result.distance, apart(1.5, 0.5), 1e-12);
    requireBracket(result, apart(1.5, 0.5));
  }
}

TEST_F(Pendulum, LosesOnlyTheRoundingOfItsPoseFarFromTheOrigin) {
  hang(1.5, "", 1e6);
  parameters.tolerance = 1e-5;
  const ClearanceResult result = clearance(joint("swing", {-1.0, 2.0}));
  EXPECT_EQ(result.status, ClearanceStatus::Ok);
  requireBracket(result, 0.2, 1e-8);
}

TEST_F(Pendulum, KeepsItsBracketWhereTheToleranceIsBelowTheRounding) {
  hang(1.5, "", 1e6);
  parameters.tolerance = 1e-13;
  parameters.sample_limit = 5000;
  const ClearanceResult result = clearance(joint("swing", {-0.01, 0.01}));
  EXPECT_EQ(result.status, ClearanceStatus::BudgetExhausted);
  EXPECT_LE(result.lower_bound, 0.2 + 1e-8);
  EXPECT_GE(result.distance, 0.2 - 1e-8);
}

// The largest numbers that a motion may have: little can be proven, but nothing that is wrong.
TEST_F(Pendulum, KeepsItsBracketInMotionsOfTheLargestNumbers) {
  hang(1.5);
  JointMotion motion = joint("swing", {-1e18, 1e18});
  const auto require = [&] {
    const ClearanceResult result = clearance(motion);
    EXPECT_TRUE(std::isfinite(result.distance) && std::isfinite(result.time));
    EXPECT_GE(result.distance, 0.2 - kRounding);
    EXPECT_GE(result.lower_bound, 0.0);
    EXPECT_LE(result.lower_bound, 0.2 + kRounding);
  };
  parameters.sample_limit = 5000;
  require();
  motion.times = {-1e18, 1e18};
  motion.velocities = Eigen::Vector2d(1e18, 1e18);
  require();
  motion.accelerations = Eigen::Vector2d(-1e18, 1e18);
  require();
}

TEST_F(Pendulum, RunsOnTheSplineOfItsVelocities) {
  hang(1.5);
  parameters.tolerance = 1e-6;
  // From -1 to -1 rad by 4 rad/s: a cubic that comes to -1 + 4/8 * 2 = 0 rad, at half time.
  JointMotion motion = joint("swing", {-1.0, -1.0});
  motion.velocities = Eigen::Vector2d(4.0, -4.0);
  requireBracket(clearance(motion), 0.2);
  EXPECT_NEAR(clearance(motion).time, 0.5, 1e-2);
  // A quintic with the same ends: at half time 4/2 * 5/16 * 2 - 1 + (a0 + a1)/2 * 1/32.
  motion.accelerations = Eigen::Vector2d(-8.0, -8.0);
  requireBracket(clearance(motion), apart(1.5, -1.0 + 1.25 - 0.25));
  motion.velocities.resize(0, 0);
  motion.accelerations.resize(0, 0);
  requireBracket(clearance(motion), apart(1.5, -1.0));
}

TEST_F(Pendulum, GivesOneAnswerWhateverTheNumberOfThreads) {
  hang(1.5);
  parameters.tolerance = 1e-6;
  parameters.threshold = 0.4;
  std::vector<ClearanceResult> results;
  for (const std::uint32_t threads : {1U, 2U, 0U}) {
    parameters.threads = threads;
    results.push_back(clearance(joint("swing", {-1.0, 2.0, 9.0})));
    EXPECT_EQ(results.back().distance, results.front().distance);
    EXPECT_EQ(results.back().lower_bound, results.front().lower_bound);
    EXPECT_EQ(results.back().time, results.front().time);
    EXPECT_EQ(results.back().queries, results.front().queries);
    EXPECT_EQ(results.back().first_below->time, results.front().first_below->time);
    EXPECT_EQ(results.back().first_below->proven_until, results.front().first_below->proven_until);
  }
}

TEST_F(Pendulum, KeepsItsBracketWhenItIsCutShort) {
  hang(1.5);
  parameters.tolerance = 1e-9;
  parameters.threshold = 0.3;
  double lower_before = 0.0;
  for (const std::uint64_t limit : {1U, 40U, 200U, 1000U}) {
    parameters.sample_limit = limit;
    const ClearanceResult result = clearance(joint("swing", {-1.0, 2.0}));
    EXPECT_EQ(result.status, ClearanceStatus::BudgetExhausted) << limit;
    EXPECT_LE(result.lower_bound, 0.2);
    EXPECT_GE(result.distance, 0.2);
    EXPECT_GE(result.lower_bound, lower_before);
    EXPECT_LE(result.first_below->proven_until, (1.0 - std::acos((1.0 + 2.25 - 0.36) / 3.0)) / 3.0);
    lower_before = result.lower_bound;
  }
}

TEST_F(Pendulum, EndsWhenItIsStopped) {
  hang(1.5);
  parameters.tolerance = 1e-9;
  std::atomic<bool> stop{true};
  parameters.stop = &stop;
  const ClearanceResult result = clearance(joint("swing", {-1.0, 2.0}));
  EXPECT_EQ(result.status, ClearanceStatus::BudgetExhausted);
  EXPECT_LT(result.queries, 50U);
}

TEST_F(Pendulum, ReportsItsProgress) {
  hang(1.5);
  parameters.tolerance = 1e-12;
  std::atomic<bool> stop{false};
  parameters.stop = &stop;
  double fraction = -1.0;
  int reports = 0;
  parameters.progress = [&](const ClearanceProgress& progress) {
    EXPECT_GE(progress.fraction, fraction);
    EXPECT_LE(progress.fraction, 1.0);
    EXPECT_LE(progress.lower_bound, 0.2);
    EXPECT_GE(progress.distance, 0.2);
    fraction = progress.fraction;
    stop = ++reports == 3;
  };
  EXPECT_EQ(clearance(joint("swing", {-1.0, 2.0})).status, ClearanceStatus::BudgetExhausted);
  EXPECT_EQ(reports, 3);
}

// ---- a path of poses ----

TEST_F(ClearanceTest, OfABallPastTheEdgeOfABoxIsThatOfTheFormula) {
  useBodies(
      "  - {name: box, frame: world, box: {size: [2, 2, 2]}}\n  - {name: ball, frame: ball, sphere: {radius: "
      "0.25}}\n");
  parameters.tolerance = 1e-6;
  // Across the edge x = z = 1, in the plane of both normals: nearest where it is diagonal above the edge.
  const ClearanceResult result = clearance(straight("ball", {0.5, 0.0, 3.5}, {3.0, 0.3, 1.0}));
  EXPECT_EQ(result.status, ClearanceStatus::Ok);
  requireBracket(result, std::sqrt(2.0) - 0.25);
  EXPECT_NEAR(result.time, 0.6, 1e-2);
}

// The blade stands across the plate's plane at no waypoint, and at none of any number of equal steps from 2
// to 200.
TEST_F(ClearanceTest, FindsAThinBladeThatCrossesAPlateBetweenTwoSamples) {
  useBodies(
      "  - {name: plate, frame: world, box: {size: [1, 1, 0.0001]}}\n"
      "  - {name: blade, frame: blade, box: {size: [0.5, 0.5, 0.0001]}}\n");
  const double crossing = 0.50123;
  const ClearanceResult result =
      clearance(straight("blade", {0.0, 0.0, crossing}, {0.0, 0.0, crossing - 1.0}));
  EXPECT_EQ(result.status, ClearanceStatus::Penetrating);
  EXPECT_EQ(result.distance, 0.0);
  EXPECT_NEAR(result.time, crossing, 1e-4);
  ASSERT_TRUE(result.first_below.has_value());
  EXPECT_LE(result.first_below->proven_until, crossing - 1e-4 + 1e-12);
  EXPECT_GE(result.first_below->time, crossing - 1e-4 - 1e-12);
  EXPECT_LE(result.first_below->time - result.first_below->proven_until, parameters.tolerance);
}

TEST_F(ClearanceTest, FindsWhatIsInsideFromTheStartAndWhatComesInside) {
  useBodies(
      "  - {name: box, frame: world, box: {size: [2, 2, 2]}}\n  - {name: grain, frame: grain, box: {size: "
      "[0.01, "
      "0.01, 0.01]}}\n");
  const ClearanceResult inside = clearance(straight("grain", {0.5, 0.5, 0.5}, {0.0, 0.0, 0.0}));
  EXPECT_EQ(inside.status, ClearanceStatus::Penetrating);
  EXPECT_EQ(inside.first_below->proven_until, 0.0);
  EXPECT_EQ(inside.first_below->time, 0.0);
  const ClearanceResult entering = clearance(straight("grain", {0.0, 0.0, 3.005}, {0.0, 0.0, 0.0}));
  EXPECT_EQ(entering.status, ClearanceStatus::Penetrating);
  EXPECT_NEAR(entering.first_below->time, 2.0 / 3.005, 1e-3);
  EXPECT_LE(entering.first_below->proven_until, 2.0 / 3.005);
}

// A corner of the turning box comes nearest to the wall: half a diagonal from its centre.
TEST_F(ClearanceTest, OfABoxThatTurnsBesideAWallIsThatOfItsDiagonal) {
  useBodies(
      "  - {name: wall, frame: world, box: {size: [1, 9, 9]}, pose: {xyz: [2.5, 0, 0]}}\n"
      "  - {name: box, frame: box, box: {size: [1, 1, 1]}}\n");
  parameters.tolerance = 1e-6;
  PoseMotion motion = straight("box", Vector3d::Zero(), Vector3d::Zero());
  motion.rotations[1] = Eigen::AngleAxisd(kPi / 2.0, Vector3d::UnitZ());
  const ClearanceResult result = clearance(motion);
  requireBracket(result, 2.0 - std::sqrt(0.5));
  EXPECT_NEAR(result.time, 0.5, 1e-3);
}

TEST_F(ClearanceTest, GoesOverSeveralTurnsOfAPoseFromWaypointToWaypoint) {
  useBodies(
      "  - {name: wall, frame: world, box: {size: [1, 9, 9]}, pose: {xyz: [2.5, 0, 0]}}\n"
      "  - {name: box, frame: box, box: {size: [1, 1, 1]}}\n");
  PoseMotion motion;
  motion.body = "box";
  for (int i = 0; i <= 12; ++i) {
    motion.positions.emplace_back(0.01 * i, 0.0, 0.0);
    motion.rotations.emplace_back(Eigen::AngleAxisd(0.5 * i, Vector3d(0.0, i % 2, 1.0).normalized()));
  }
  const ClearanceResult result = clearance(motion);
  EXPECT_EQ(result.status, ClearanceStatus::Ok);
  double least = 9.0;
  for (std::size_t i = 0; i < 12; ++i) {
    for (double share = 0.0; share <= 1.0; share += 1.0 / 256.0) {
      const Eigen::Matrix3d rotation =
          motion.rotations[i].slerp(share, motion.rotations[i + 1]).toRotationMatrix();
      const double reach = 0.5 * rotation.row(0).cwiseAbs().sum();
      least = std::min(least, 2.0 - reach - 0.01 * (static_cast<double>(i) + share));
    }
  }
  EXPECT_LE(result.lower_bound, least);
  EXPECT_LE(result.distance, least + parameters.tolerance);
  EXPECT_GE(result.lower_bound, result.distance - parameters.tolerance);
}

TEST_F(ClearanceTest, MovesWhatIsAttachedToABodyWithIt) {
  useBodies(
      "  - {name: wall, frame: world, box: {size: [1, 9, 9]}, pose: {xyz: [3.5, 0, 0]}}\n"
      "  - {name: box, frame: box, box: {size: [1, 1, 1]}}\n"
      "  - {name: tool, frame: box, box: {size: [0.2, 0.2, 0.2]}}\n");
  auto attachment = std::make_shared<Attachment>();
  attachment->parent = "box";
  attachment->parent_serial = scene.bodies[body("box")].serial;
  scene.bodies.edit(body("tool")).attachment = attachment;
  scene.bodies.edit(body("tool")).carrier = scene.bodies[body("box")].serial;
  scene.bodies.edit(body("box")).carrier = scene.bodies[body("box")].serial;
  joints.emplace(scene);
  state.world_from_body[body("box")] = Eigen::Isometry3d(Eigen::Translation3d(-5.0, 0.0, 0.0));
  state.world_from_body[body("tool")] = Eigen::Isometry3d(Eigen::Translation3d(-4.2, 0.0, 0.0));
  const ClearanceResult result = clearance(straight("box", Vector3d::Zero(), {1.0, 0.0, 0.0}));
  requireBracket(result, 1.1);
  EXPECT_EQ(scene.bodies[result.body_b].name, "tool");
  EXPECT_EQ(result.pairs.size(), 2U) << "the box and its tool do not move against each other";
}

// ---- which pairs ----

TEST_F(ClearanceTest, LooksAtThePairsThatTheSceneWatches) {
  const std::string bodies =
      "  - {name: wall, frame: world, box: {size: [1, 9, 9]}, pose: {xyz: [3.5, 0, 0]}}\n"
      "  - {name: post, frame: world, box: {size: [0.1, 0.1, 9]}, pose: {xyz: [2, 0, 0]}}\n"
      "  - {name: box, frame: box, box: {size: [1, 1, 1]}}\n"
      "  - {name: lost, frame: lost, box: {size: [1, 1, 1]}}\n";
  const PoseMotion motion = straight("box", Vector3d::Zero(), {1.0, 0.0, 0.0});
  useBodies(bodies, "defaults: {cutoff: 0.01}\npairs:\n  - {between: [box, wall]}\n");
  requireBracket(clearance(motion), 1.5);
  useBodies(bodies);
  state.world_from_body[body("lost")].reset();
  const ClearanceResult all = clearance(motion);
  requireBracket(all, 0.45);
  EXPECT_EQ(all.pairs.size(), 2U);
  EXPECT_EQ(all.not_located, std::vector<std::size_t>{body("lost")});
  useBodies(bodies, "pairs:\n  - {between: [wall, post]}\n");
  EXPECT_EQ(clearance(motion).status, ClearanceStatus::NoPairs);
}

TEST_F(ClearanceTest, ProvesEachPairWhereThatIsAskedFor) {
  useBodies(
      "  - {name: near, frame: world, box: {size: [1, 9, 9]}, pose: {xyz: [3.5, 0, 0]}}\n"
      "  - {name: far, frame: world, box: {size: [1, 9, 9]}, pose: {xyz: [9.5, 0, 0]}}\n"
      "  - {name: box, frame: box, box: {size: [1, 1, 1]}}\n");
  const PoseMotion motion = straight("box", Vector3d::Zero(), {1.0, 0.0, 0.0});
  parameters.each_pair = true;
  const ClearanceResult result = clearance(motion);
  ASSERT_EQ(result.pairs.size(), 2U);
  for (const PairClearance& pair : result.pairs) {
    const double truth = pair.body_a == body("near") || pair.body_b == body("near") ? 1.5 : 7.5;
    EXPECT_NEAR(pair.distance, truth, parameters.tolerance);
    EXPECT_LE(pair.lower_bound, truth);
    EXPECT_GE(pair.lower_bound, pair.distance - parameters.tolerance);
  }
  EXPECT_NEAR(result.distance, 1.5, parameters.tolerance);
}

TEST_F(ClearanceTest, ListsTheNichesOfTheNearestPair) {
  useBodies(
      "  - name: posts\n    frame: world\n    shapes:\n"
      "      - {box: {size: [0.2, 0.2, 1]}, pose: {xyz: [0.4, 0, 0]}}\n"
      "      - {box: {size: [0.2, 0.2, 1]}, pose: {xyz: [-0.4, 0, 0]}}\n"
      "  - {name: plate, frame: plate, box: {size: [2, 1, 0.1]}}\n");
  parameters.niches = true;
  const ClearanceResult result = clearance(straight("plate", {0.0, 0.0, 2.0}, {0.0, 0.0, 1.0}));
  requireBracket(result, 0.45);
  ASSERT_TRUE(result.solution.has_value());
  EXPECT_EQ(result.solution->niches.size(), 2U);
  EXPECT_NEAR(result.solution->distance, result.distance, kRounding);
}

// ---- what is refused ----

TEST_F(Pendulum, RefusesMotionsThatItCannotPlay) {
  hang(1.5);
  using test::mentions;
  const JointMotion good = joint("swing", {0.0, 1.0});
  const auto refused = [&](const auto& change) {
    JointMotion motion = good;
    change(motion);
    return refusal(motion);
  };
  EXPECT_TRUE(mentions(refused([](JointMotion& m) { m = {}; }), "no waypoint"));
  EXPECT_TRUE(mentions(refused([](JointMotion& m) { m.joints = {"wing"}; }), "no robot of the scene has it"));
  EXPECT_TRUE(mentions(refused([](JointMotion& m) {
                         m.joints = {"swing", "swing"};
                       }),
                       "their size is 2 x 1"));
  EXPECT_TRUE(mentions(refused([](JointMotion& m) {
                         m.joints = {"swing", "swing"};
                         m.positions = Eigen::Matrix2d::Zero();
                       }),
                       "'swing': it is given twice"));
  EXPECT_TRUE(mentions(refused([](JointMotion& m) { m.positions(1, 0) = std::nan(""); }),
                       "waypoint 1, joint 'swing': one of the positions is nan"));
  EXPECT_TRUE(mentions(refused([](JointMotion& m) { m.times = {0.0, -1.0}; }), "waypoint 1: its time, -1 s"));
  EXPECT_TRUE(mentions(refused([](JointMotion& m) { m.times = {0.0, 0.0}; }), "only equal waypoints"));
  EXPECT_TRUE(mentions(refused([](JointMotion& m) { m.times = {0.0}; }), "1 time for 2 waypoints"));
  for (const double time : {static_cast<double>(INFINITY), 1.1e18}) {
    EXPECT_TRUE(
        mentions(refused([&](JointMotion& m) { m.times[1] = time; }), "not finite, or beyond 1e18 s"));
  }
  EXPECT_TRUE(mentions(refused([](JointMotion& m) { m.velocities = Eigen::Vector3d::Zero(); }),
                       "velocities: their size is 3 x 1"));
  EXPECT_TRUE(mentions(refused([](JointMotion& m) { m.accelerations = Eigen::Vector2d::Zero(); }),
                       "without velocities"));
  EXPECT_TRUE(mentions(refused([](JointMotion& m) {
                         m.velocities = Eigen::Vector2d::Zero();
                         m.times.clear();
                       }),
                       "without times"));
  EXPECT_EQ(refused([](JointMotion&) {}), "accepted");
  EXPECT_EQ(refused([](JointMotion& m) {
              m.positions(1, 0) = 0.0;
              m.times = {0.0, 0.0};
            }),
            "accepted");
}

TEST_F(Pendulum, RefusesParametersOutOfRange) {
  hang(1.5);
  using test::mentions;
  const auto refused = [&](const auto& change) {
    parameters = {};
    change(parameters);
    return refusal(joint("swing", {0.0, 1.0}));
  };
  for (const double tolerance : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    EXPECT_TRUE(mentions(refused([&](ClearanceParameters& p) { p.tolerance = tolerance; }), "tolerance: "));
  }
  EXPECT_TRUE(mentions(refused([](ClearanceParameters& p) { p.threshold = -0.1; }), "threshold: "));
  EXPECT_TRUE(mentions(refused([](ClearanceParameters& p) { p.time_budget = 0.0; }), "time_budget: "));
  EXPECT_TRUE(mentions(refused([](ClearanceParameters& p) { p.sample_limit = 0; }), "sample_limit: "));
}

TEST_F(ClearanceTest, RefusesPosesThatAreNone) {
  useBodies(
      "  - {name: a, frame: a, box: {size: [1, 1, 1]}}\n  - {name: b, frame: b, box: {size: [1, 1, 1]}}\n");
  using test::mentions;
  PoseMotion motion = straight("a", Vector3d::Zero(), Vector3d::UnitX());
  motion.body = "c";
  EXPECT_TRUE(mentions(refusal(motion), "body 'c': the scene has no such body"));
  motion.body = "a";
  motion.rotations[1].coeffs() *= 2.0;
  EXPECT_TRUE(mentions(refusal(motion), "waypoint 1: the norm of its quaternion is 2"));
  motion.rotations.pop_back();
  EXPECT_TRUE(mentions(refusal(motion), "2 positions and 1 rotation"));
}

TEST_F(ClearanceTest, WatchesLimitsAndMimicsOfTheJointsThatAMotionNames) {
  options.descriptions["robot"] = test::mobileRobot();
  use(load("defaults: {max_edge_length: 100}\nrobots:\n  - {description: robot}\n"));
  using test::mentions;
  EXPECT_EQ(clearance(joint("swing", {0.0, 2.5})).outside_limits, std::vector<std::string>{"swing"});
  EXPECT_TRUE(clearance(joint("swing", {0.0, 2.0})).outside_limits.empty());
  EXPECT_TRUE(mentions(refusal(joint("drive/x", {0.0, 1.0})), "names 1 of its 3 positions"));
  EXPECT_TRUE(mentions(refusal(joint("bolt", {0.0, 1.0})), "fixed"));
  EXPECT_TRUE(mentions(refusal(joint("grip2", {0.0, 1.0})), "mimics 'grip', which the motion does not name"));
  JointMotion both = joint("grip", {0.0, 1.0});
  both.joints.push_back("grip2");
  both.positions = (Eigen::Matrix2d() << 0.0, 0.01, 1.0, -0.99).finished();
  EXPECT_EQ(refusal(both), "accepted");
  both.positions(1, 1) = 0.5;
  EXPECT_TRUE(mentions(refusal(both), "waypoint 1, joint 'grip2': its position is 0.5"));
}

}  // namespace
}  // namespace concave_distance::clearance_test
