#include "concave_distance/kinematics/velocity_guard.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "concave_distance/base/error.h"
#include "support/count_allocations.h"
#include "support/robots.h"
#include "support/scene_fixture.h"

namespace concave_distance::velocity_guard_test {
namespace {

/// How far a robot comes that closes with a scale for the reaction time and then brakes evenly, beside an
/// obstacle that goes on coming: by steps, and not by the law's formula.
double travelled(double scale, double closing, double drift, double reaction, double braking_time) {
  constexpr int kSteps = 4000;
  const double braking = scale * braking_time;
  const double whole = reaction + braking;
  double way = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double time = (i + 0.5) * whole / kSteps;
    const double left = time < reaction || braking == 0.0 ? 1.0 : 1.0 - (time - reaction) / braking;
    way += (scale * closing * left + std::max(0.0, drift)) * whole / kSteps;
  }
  return way;
}

TEST(LargestScale, NeverTravelsFurtherThanTheRoomAndUsesItWhereItLimits) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int limited = 0;
  int still = 0;
  for (int i = 0; i < 2000; ++i) {
    const double room = 0.5 * unit(engine) - 0.05;
    const double closing = 1e-3 + 2.0 * unit(engine);
    const double drift = unit(engine) - 0.6;
    const double reaction = 0.3 * unit(engine);
    const double braking = 1.5 * unit(engine);
    const double scale = largestScale(room, closing, drift, reaction, braking);
    ASSERT_GE(scale, 0.0);
    ASSERT_LE(scale, 1.0);
    const double way = travelled(scale, closing, drift, reaction, braking);
    if (scale == 0.0) {
      ++still;
      ASSERT_GE(std::max(0.0, drift) * reaction, room) << "there was room left";
      continue;
    }
    ASSERT_LE(way, room + 1e-3 * (1.0 + room));
    if (scale == 1.0) continue;
    ++limited;
    ASSERT_NEAR(way, room, 1e-3 * (1.0 + room));
  }
  EXPECT_GT(limited, 300);
  EXPECT_GT(still, 100);
}

TEST(LargestScale, IsTheClosedFormOfAnEvenlyBrakedStop) {
  // 0.5 m/s, 0.1 s, 1 m/s^2: 0.05 + 0.125 m at scale 1.
  EXPECT_EQ(largestScale(0.175, 0.5, 0.0, 0.1, 0.5), 1.0);
  const double scale = largestScale(0.05, 0.5, 0.0, 0.1, 0.5);
  EXPECT_NEAR(scale * 0.05 + scale * scale * 0.125, 0.05, 1e-15);
  EXPECT_EQ(largestScale(0.0, 0.5, 0.0, 0.1, 0.5), 0.0);
  EXPECT_EQ(largestScale(-0.01, 0.5, 0.0, 0.1, 0.5), 0.0);
  EXPECT_EQ(largestScale(0.05, 0.5, -0.4, 0.1, 0.5), scale) << "who flees may stop";
  EXPECT_EQ(largestScale(0.05, 0.5, 0.5, 0.1, 0.5), 0.0) << "what comes by itself takes all of it";
}

GuardPlace placeAt(double value, double closing, double drift = 0.0) {
  GuardPlace place;
  place.id = 5;
  place.value = value;
  place.closing = closing;
  place.drift = drift;
  return place;
}

/// The law of a guard with its default settings, as velocity_guard.md has it.
double lawAt(double room, double closing, double drift = 0.0, double braking_time = 0.0) {
  const double braking = std::max(braking_time, closing);  // 1 m/s^2
  return largestScale(room - 0.1 * drift, closing, 0.0, 0.1 * std::exp(1.0) + drift * braking / closing,
                      braking);
}

GuardSettings quick() {
  GuardSettings settings;
  settings.rise_time = 0.0;
  return settings;
}

TEST(VelocityGuard, LimitsByThePlaceThatClosesAndNotByThoseThatOpen) {
  VelocityGuard guard(quick());
  EXPECT_EQ(guard.decide({placeAt(0.021, -1.0), placeAt(0.0, 0.0)}, 0.0, 1.0, 1.0).scale, 1.0);
  EXPECT_EQ(guard.last().reason, GuardReason::Free);
  EXPECT_EQ(guard.last().id, GuardDecision::kNone);
  GuardPlace nearer = placeAt(0.06, 0.5);
  nearer.id = 6;
  const GuardDecision decision =
      guard.decide({placeAt(0.1, 0.5), nearer, placeAt(-0.1, -1.0)}, 0.0, 1.1, 1.1);
  EXPECT_EQ(decision.id, 6U);
  EXPECT_EQ(decision.reason, GuardReason::Closing);
  EXPECT_NEAR(decision.room, 0.04, 1e-15);
  EXPECT_NEAR(decision.scale, lawAt(0.04, 0.5), 1e-12);
  EXPECT_NEAR(decision.stopping_distance, 0.05 * std::exp(1.0) + 0.125, 1e-12);
}

TEST(VelocityGuard, LeavesAnOverlapWithASignedValueAndEntersNone) {
  VelocityGuard guard(quick());
  EXPECT_EQ(guard.decide({placeAt(-0.01, -0.1)}, 0.0, 1.0, 1.0).scale, 1.0);
  EXPECT_EQ(guard.decide({placeAt(-0.01, 0.1)}, 0.0, 1.0, 1.0).scale, 0.0);
  GuardPlace overlap = placeAt(0.0, -0.1);
  overlap.kind = GuardPlace::Kind::Overlaps;
  EXPECT_EQ(guard.decide({overlap}, 0.0, 1.0, 1.0).scale, 0.0);
  EXPECT_EQ(guard.last().reason, GuardReason::Overlaps);
}

TEST(VelocityGuard, TakesTheMoreCarefulOfCommandAndMeasurement) {
  VelocityGuard guard(quick());
  GuardPlace place = placeAt(0.1, 0.2, 0.05);
  const double told = guard.decide({place}, 0.0, 1.0, 1.0).scale;
  place.measured = 0.2;
  EXPECT_EQ(guard.decide({place}, 0.0, 1.0, 1.0).scale, told);
  place.measured = 0.55;
  EXPECT_NEAR(guard.decide({place}, 0.0, 1.0, 1.0).scale, lawAt(0.08, 0.5, 0.05), 1e-12);
  place.closing = -0.2;
  EXPECT_EQ(guard.decide({place}, 0.0, 1.0, 1.0).scale, 1.0) << "a command that brakes is not held back";
}

TEST(VelocityGuard, CountsTheJointThatBrakesLongest) {
  VelocityGuard guard(quick());
  EXPECT_NEAR(guard.decide({placeAt(0.1, 0.2)}, 2.0, 1.0, 1.0).scale, lawAt(0.08, 0.2, 0.0, 2.0), 1e-12);
}

TEST(VelocityGuard, StopsForWhatIsNotKnown) {
  VelocityGuard guard(quick());
  const double nan = std::nan("");
  EXPECT_EQ(guard.last().scale, 0.0);
  EXPECT_EQ(guard.last().reason, GuardReason::NoRows);
  const auto expectStop = [&](const GuardPlace& place, GuardReason reason) {
    EXPECT_EQ(guard.decide({placeAt(1.0, -1.0), place}, 0.0, 1.0, 1.0).scale, 0.0);
    EXPECT_EQ(guard.last().reason, reason);
    EXPECT_EQ(guard.last().id, 5U);
  };
  GuardPlace unknown = placeAt(1.0, 0.0);
  unknown.kind = GuardPlace::Kind::Unknown;
  expectStop(unknown, GuardReason::Unknown);
  expectStop(placeAt(1.0, 0.1, nan), GuardReason::Unknown);
  expectStop(placeAt(nan, 0.1), GuardReason::NotFinite);
  expectStop(placeAt(1.0, nan), GuardReason::NotFinite);
  expectStop(placeAt(1.0, INFINITY), GuardReason::NotFinite);
  EXPECT_EQ(guard.decide({placeAt(1.0, -0.1, nan)}, 0.0, 1.0, 1.0).scale, 1.0) << "it opens all the same";
  EXPECT_EQ(guard.decide(std::vector<GuardPlace>(), nan, 1.0, 1.0).reason, GuardReason::NotFinite);
  EXPECT_EQ(guard.decide(std::vector<GuardPlace>(), 0.0, 1.0, 1.21).reason, GuardReason::Stale);
  EXPECT_EQ(guard.decide(std::vector<GuardPlace>(), 0.0, 1.6, 1.3).reason, GuardReason::Stale);
  EXPECT_EQ(guard.decide(std::vector<GuardPlace>(), 0.0, nan, 1.3).reason, GuardReason::Stale);
  EXPECT_EQ(guard.decide(std::vector<GuardPlace>(), 0.0, 1.3, 1.3).scale, 1.0);
  EXPECT_EQ(guard.decide(std::vector<GuardPlace>(), 0.0, 0.5, 0.5).reason, GuardReason::ClockBack);
  EXPECT_EQ(guard.last().scale, 0.0);
  EXPECT_EQ(guard.stop(GuardReason::BadCommand, 0.6).scale, 0.0);
}

TEST(VelocityGuard, FallsAtOnceAndRisesSlowly) {
  VelocityGuard guard;  // 0.25 s from 0 to 1
  const std::vector<GuardPlace> none;
  const std::vector<GuardPlace> wall{placeAt(0.0, 1.0)};
  EXPECT_EQ(guard.decide(none, 0.0, 1.0, 1.0).scale, 0.0) << "it begins at 0";
  EXPECT_NEAR(guard.decide(none, 0.0, 1.1, 1.1).scale, 0.4, 1e-12);
  EXPECT_EQ(guard.last().reason, GuardReason::Rising);
  EXPECT_EQ(guard.decide(none, 0.0, 1.3, 1.3).scale, 1.0);
  EXPECT_EQ(guard.decide(wall, 0.0, 1.31, 1.31).scale, 0.0);
  // A threshold that is crossed in every cycle: no rise is more than its share.
  double last = 0.0;
  for (int i = 0; i < 100; ++i) {
    const double now = 1.32 + 0.01 * i;
    const double scale = guard.decide(i % 3 == 0 ? wall : none, 0.0, now, now).scale;
    EXPECT_LE(scale, last + 0.04 + 1e-9);
    last = scale;
  }
  guard.reset();
  EXPECT_EQ(guard.decide(none, 0.0, 9.0, 9.0).scale, 0.0);
}

TEST(VelocityGuard, RefusesSettingsThatAreNone) {
  GuardSettings settings;
  settings.deceleration = 0.0;
  EXPECT_THROW(VelocityGuard{settings}, Error);
  settings = {};
  settings.margin = -0.1;
  EXPECT_THROW(VelocityGuard{settings}, Error);
  settings = {};
  settings.stale_after = std::nan("");
  EXPECT_THROW(VelocityGuard{settings}, Error);
  settings = {};
  settings.joint_deceleration = 0.0;
  EXPECT_THROW(VelocityGuard{settings}, Error);
}

/// A cube that slides between two walls 2 m apart, on a joint.
class GuardedRowsTest : public test::SceneTest {
 protected:
  void setUp(const std::string& defaults = "defaults: {cutoff: 5}\n", std::uint32_t capacity = 16) {
    options.descriptions["robot"] =
        "<robot name='slider'><link name='floor'/><link name='cube'><collision><geometry>"
        "<box size='0.2 0.2 0.2'/></geometry></collision></link>" +
        test::movingJoint("slide", "prismatic", "floor", "cube", "<axis xyz='1 0 0'/>") + "</robot>";
    scene = load(defaults +
                 "robots:\n  - {description: robot}\nbodies:\n"
                 "  - {name: right, frame: world, box: {size: [0.1, 1, 1]}, pose: {xyz: [1.15, 0, 0]}}\n"
                 "  - {name: left, frame: cart, box: {size: [0.1, 1, 1]}, pose: {xyz: [-1.15, 0, 0]}}\n");
    joints = std::make_shared<const SceneKinematics>(scene);
    tracker.setScene(scene);
    state = joints->startState();
    ConstraintSettings settings;
    settings.distance = 3.0;
    settings.capacity = capacity;
    rows.emplace(joints, settings);
  }
  void cycle(double position, bool has_left = true, double cart = 0.0) {
    joints->evaluate(Eigen::VectorXd::Constant(1, position), state);
    const std::size_t left = *scene.findBody("left");
    state.world_from_body[left].reset();
    if (has_left)
      state.world_from_body[left] = Eigen::Translation3d(cart, 0, 0) * scene.bodies[left].frame_from_body;
    time += 0.01;
    tracker.update(state.world_from_body, time);
    rows->update(tracker.pairs(), state, time);
  }
  const GuardDecision& decide(VelocityGuard& guard, double velocity) {
    return guard.decide(*rows, Eigen::VectorXd::Constant(1, velocity), time, time);
  }

  Scene scene;
  std::shared_ptr<const SceneKinematics> joints;
  SceneTracker tracker{{1, nullptr}};
  SceneState state;
  std::optional<ConstraintRows> rows;
  double time = 0.0;
};

TEST_F(GuardedRowsTest, SlowTheApproachToEitherWallAndNoRetreat) {
  setUp();
  VelocityGuard guard(quick());
  cycle(0.9);
  cycle(0.9);
  // 0.1 m from the right wall, 1.9 m from the left one.
  EXPECT_NEAR(decide(guard, 1.0).scale, lawAt(0.08, 1.0), 1e-9);
  EXPECT_EQ(decide(guard, -1.0).scale, 1.0);
  cycle(0.985);
  EXPECT_EQ(decide(guard, 0.1).scale, 0.0) << "less than the margin is left";
  EXPECT_EQ(decide(guard, -1.0).scale, 1.0);
}

TEST_F(GuardedRowsTest, KnowWhatComesByItselfByItsPart) {
  setUp();
  VelocityGuard guard(quick());
  cycle(-0.5, true, 0.0);
  cycle(-0.5, true, 0.002);  // 0.2 m/s, 0.498 m left
  for (const ConstraintRow& row : rows->rows()) {
    if (row.state != SlotState::Used) continue;
    const bool is_left = row.pair->body_a->name == "left" || row.pair->body_b->name == "left";
    const bool left_is_a = row.pair->body_a->name == "left";
    EXPECT_NEAR(row.drift, is_left ? 0.2 : 0.0, 1e-9);
    EXPECT_NEAR(left_is_a ? row.drift_a : row.drift_b, is_left ? 0.2 : 0.0, 1e-9);
  }
  EXPECT_NEAR(decide(guard, -1.0).scale, lawAt(0.478, 1.0, 0.2), 1e-6);
  EXPECT_EQ(decide(guard, 0.5).scale, 1.0);
}

TEST_F(GuardedRowsTest, StopForABodyWithoutAPose) {
  setUp();
  VelocityGuard guard(quick());
  cycle(0.0);
  cycle(0.0, false);
  ASSERT_EQ(rows->unlisted().size(), 1U);
  EXPECT_EQ(rows->unlisted()[0].reason, UnlistedReason::NoPose);
  EXPECT_EQ(joints->nameOf(rows->unlisted()[0].body), "left");
  EXPECT_EQ(decide(guard, 0.1).scale, 0.0);
  EXPECT_EQ(decide(guard, 0.1).reason, GuardReason::Unknown);
}

TEST_F(GuardedRowsTest, BoundWhatHasNoSlot) {
  setUp("defaults: {cutoff: 5}\n", 4);  // the right wall's four corners are nearer
  VelocityGuard guard(quick());
  cycle(0.5);
  cycle(0.5);
  ASSERT_EQ(rows->unlisted().size(), 1U);
  const UnlistedPlaces& places = rows->unlisted()[0];
  EXPECT_EQ(places.reason, UnlistedReason::NoSlot);
  EXPECT_NEAR(places.lower_bound, 1.5, 1e-9);
  EXPECT_NEAR(rows->reach()(0, 0), 1.0, 1e-9) << "a sliding joint: 1 m/s for 1 m/s";
  EXPECT_NEAR(decide(guard, -2.0).scale, lawAt(1.48, 2.0), 1e-9);
}

TEST_F(GuardedRowsTest, SayWhatACutoffHides) {
  setUp("defaults: {cutoff: 1}\n");
  cycle(0.9);
  ASSERT_EQ(rows->unlisted().size(), 1U) << "of the near pair; the other one is not in the tracker's list";
  EXPECT_EQ(rows->unlisted()[0].reason, UnlistedReason::BeyondCutoff);
  EXPECT_EQ(rows->unlisted()[0].lower_bound, 1.0);
}

TEST_F(GuardedRowsTest, RefuseAnotherNumberOfVelocitiesAndStopForOneThatIsNotFinite) {
  setUp();
  VelocityGuard guard(quick());
  cycle(0.0);
  EXPECT_THROW(guard.decide(*rows, Eigen::VectorXd::Zero(2), time, time), Error);
  EXPECT_EQ(decide(guard, std::nan("")).reason, GuardReason::NotFinite);
}

TEST_F(GuardedRowsTest, AllocateNothingOnceWarm) {
  setUp();
  VelocityGuard guard;
  const Eigen::VectorXd velocities = Eigen::VectorXd::Constant(1, 0.3);
  for (int i = 0; i < 20; ++i) {
    cycle(0.002 * i);
    decide(guard, 0.3);
  }
  cycle(0.05);
  const std::size_t before = allocations;
  guard.decide(*rows, velocities, time, time);
  EXPECT_EQ(allocations - before, 0U);
}

// Whole stops with the law in the loop: late, braking as it says, never past the margin.
TEST_F(GuardedRowsTest, KeepTheMarginInAClosedLoop) {
  for (const double wanted : {0.3, 1.0, -2.0}) {
    setUp();
    GuardSettings settings;
    settings.reaction_time = 0.06;
    VelocityGuard guard(settings);
    std::vector<double> pending(5, 0.0);
    double position = 0.0;
    double velocity = 0.0;
    double nearest = 9.0;
    for (int i = 0; i < 800; ++i) {
      cycle(position);
      pending.push_back(decide(guard, wanted).scale * wanted);
      const double target = pending[static_cast<std::size_t>(i)];
      for (int step = 0; step < 10; ++step) {
        velocity += std::clamp(target - velocity, -0.001, 0.001);
        position += 0.001 * velocity;
      }
      nearest = std::min(nearest, 1.0 - std::abs(position));
    }
    EXPECT_GE(nearest, settings.margin - 1e-9) << wanted;
    EXPECT_LE(nearest, settings.margin + 0.01) << wanted << ": it goes where it may";
  }
}

}  // namespace
}  // namespace concave_distance::velocity_guard_test
