// A ball that falls on a plate: the states against the laws of falling, and the distance node that follows
// it.
#include <concave_distance/Distances.h>
#include <concave_distance/SimulationState.h>
#include <gtest/gtest.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <cmath>

#include "rostest_support.h"

namespace concave_distance::simulation_rostest {
namespace {

constexpr double kGravity = 9.81;
constexpr double kDrop = 0.5;  // metres from the ball's lowest point to the plate

std::size_t ballOf(const SimulationState& state) {
  return static_cast<std::size_t>(std::find(state.bodies.begin(), state.bodies.end(), "ball") -
                                  state.bodies.begin());
}
double heightOf(const SimulationState& state) {
  return state.poses.at(ballOf(state)).position.z;
}

TEST(SimulationNode, TheBallFallsBouncesAndStaysInTheBooks) {
  Collector<SimulationState> states("/simulation/state");
  Collector<Distances> distances("/distance/distances");
  ASSERT_TRUE(states.waitFor([](const SimulationState& s) { return s.time > 0.49; }));
  const double impact = std::sqrt(2.0 * kDrop / kGravity);
  int falling = 0;
  double lowest = 1.0;
  double strongest = 0.0;
  bool deeper_than_proven = false;
  for (const SimulationState& state : states.all()) {
    EXPECT_FALSE(state.diverged);
    ASSERT_EQ(state.bodies.size(), state.poses.size());
    ASSERT_EQ(state.pairs.size(), 1U);
    if (state.time < impact - 0.005) {
      ++falling;
      EXPECT_NEAR(heightOf(state), 0.6 - 0.5 * kGravity * state.time * state.time, 1e-6) << state.time;
      EXPECT_EQ(state.contact_wrenches.at(ballOf(state)).force.z, 0.0) << state.time;
    }
    lowest = std::min(lowest, heightOf(state));
    strongest = std::max(strongest, state.contact_wrenches.at(ballOf(state)).force.z);
    deeper_than_proven = deeper_than_proven || (state.depths[0] > 0.0 && state.lower_bounds[0] > 0.0);
  }
  EXPECT_GT(falling, 20);
  EXPECT_LT(lowest, 0.1) << "no contact";
  EXPECT_GT(lowest, 0.05) << "through the plate";
  EXPECT_GT(strongest, 20.0) << "more than the weight";
  EXPECT_FALSE(deeper_than_proven) << "a region where the proof excludes contact";
  const SimulationState end = *states.last();
  EXPECT_GT(end.twists.at(ballOf(end)).linear.z, 0.5) << "it does not rebound";
  EXPECT_LT(std::abs(end.energy_balance_error), 0.02) << "of 4.9 J";

  // The distance node sees the same: the gap while it falls.
  ASSERT_GT(distances.count(), 0U);
  int compared = 0;
  for (const Distances& message : distances.all()) {
    for (const PairDistance& pair : message.pairs) {
      if (pair.status.code != PairStatus::OK || !(pair.distance > 0.05)) continue;
      for (const SimulationState& state : states.all()) {
        if (state.header.stamp != pair.header.stamp) continue;
        // From inside: the mesh of a ball lies within its chord error.
        EXPECT_NEAR(pair.distance, heightOf(state) - 0.1, 1.001e-3);
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 5);
}

TEST(SimulationNode, PausesAndBeginsAnewWhileTheClockGoesOn) {
  Collector<SimulationState> states("/simulation/state");
  std_srvs::SetBool pause;
  pause.request.data = 1;
  ASSERT_TRUE(ros::service::call("/simulation/pause", pause));
  ASSERT_TRUE(states.waitFor([](const SimulationState& s) { return s.paused != 0; }));
  const ros::Time before = states.last()->header.stamp;
  std_srvs::Trigger restart;
  ASSERT_TRUE(ros::service::call("/simulation/restart", restart));
  ASSERT_TRUE(states.waitFor([](const SimulationState& s) { return s.time == 0.0; }));
  EXPECT_GT(states.last()->header.stamp, before);
  EXPECT_NEAR(heightOf(*states.last()), 0.6, 1e-12);
  pause.request.data = 0;
  ASSERT_TRUE(ros::service::call("/simulation/pause", pause));
  EXPECT_TRUE(states.waitFor([](const SimulationState& s) { return s.time > 0.1 && s.paused == 0; }));
}

}  // namespace
}  // namespace concave_distance::simulation_rostest
