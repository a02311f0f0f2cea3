#include "ros/topics/nearest.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "ros/box_scene.h"
#include "ros/node/distance_cycle.h"
#include "ros/pair_demands.h"

namespace concave_distance::nearest_test {
namespace {

using test::kDistance;
using test::kRounding;

// Boxes of edge 1: b in front of a with a gap of 1, c behind a with a gap of 2, unless a test moves them.
class NearestTest : public ::testing::Test {
 protected:
  NearestTest() {
    place(buffer, "a", 0.0, now);
    place(buffer, "b", 2.0, now);
    place(buffer, "c", -3.0, now);
  }
  Nearest answer(const TransformBuffer& transforms) {
    DistanceCycle cycle(transforms, {"world", 1.0, 1});
    cycle.setScene(scene);
    cycle.run({kDistance, kDistance}, now);
    return nearestOf(cycle.pairs(), cycle.others(), "world", now);
  }
  Nearest answer() { return answer(buffer); }

  const ros::Time now{100, 0};
  TransformBuffer buffer = timelessBuffer();
  Scene scene = threeBoxes();
};

TEST_F(NearestTest, NamesTheNearestPairWithItsDistance) {
  const Nearest nearest = answer();
  EXPECT_EQ(nearest.pair, "a/b");
  EXPECT_EQ(nearest.body_a, "a");
  EXPECT_EQ(nearest.body_b, "b");
  EXPECT_NEAR(nearest.distance, 1.0, kRounding);
  EXPECT_TRUE(nearest.is_minimum);
  EXPECT_TRUE(nearest.has_lower_bound);
  EXPECT_NEAR(nearest.lower_bound, 1.0, kRounding);
  EXPECT_EQ(nearest.number, nearest.distance);
  EXPECT_EQ(nearest.pairs, 2U);
  EXPECT_EQ(nearest.message, "");
  EXPECT_EQ(nearest.header.frame_id, "world");
  EXPECT_EQ(nearest.header.stamp, now);
}

TEST_F(NearestTest, HasNoNumberWhileAPairHasNoTransform) {
  TransformBuffer without_c = timelessBuffer();
  place(without_c, "a", 0.0, now);
  place(without_c, "b", 2.0, now);
  const Nearest nearest = answer(without_c);
  EXPECT_EQ(nearest.pairs_missing, 1U);
  EXPECT_TRUE(nearest.has_distance);
  EXPECT_NEAR(nearest.distance, 1.0, kRounding) << "the smallest that is known";
  EXPECT_FALSE(nearest.is_minimum) << "c may be anywhere";
  EXPECT_FALSE(nearest.has_lower_bound);
  EXPECT_FALSE(nearest.has_number);
  EXPECT_TRUE(std::isnan(nearest.number));
  EXPECT_NE(nearest.message.find("1 of 2 pairs"), std::string::npos) << nearest.message;
  EXPECT_NE(nearest.message.find("a/c"), std::string::npos) << nearest.message;
}

TEST_F(NearestTest, PenetratingIsZeroWhateverTheOtherPairsAre) {
  TransformBuffer without_c = timelessBuffer();
  place(without_c, "a", 0.0, now);
  place(without_c, "b", 0.5, now);
  const Nearest nearest = answer(without_c);
  EXPECT_EQ(nearest.distance, 0.0);
  EXPECT_TRUE(nearest.is_minimum);
  EXPECT_TRUE(nearest.has_number);
  EXPECT_EQ(nearest.number, 0.0);
  EXPECT_EQ(nearest.lower_bound, 0.0);
}

TEST_F(NearestTest, GivesTheSmallestProvenBoundWhenAllAreBeyondTheirCutoff) {
  scene.pairs.edit(0).settings.tracker.cutoff = 0.5;
  scene.pairs.edit(1).settings.tracker.cutoff = 0.5;
  const Nearest nearest = answer();
  EXPECT_FALSE(nearest.has_distance);
  EXPECT_EQ(nearest.pair, "");
  EXPECT_EQ(nearest.pairs_beyond_cutoff, 2U);
  EXPECT_TRUE(nearest.has_lower_bound);
  EXPECT_NEAR(nearest.lower_bound, 1.0, 1e-9) << "of boxes, their bounds are their distance";
  EXPECT_LE(nearest.lower_bound, 1.0);
  EXPECT_EQ(nearest.number, nearest.lower_bound);
}

TEST_F(NearestTest, APairBeyondItsCutoffMayBeTheNearestOne) {
  scene.pairs.edit(0).settings.tracker.cutoff = 0.5;  // a/b, 1 apart; a/c is solved, 2 apart
  const Nearest nearest = answer();
  EXPECT_EQ(nearest.pair, "a/c");
  EXPECT_NEAR(nearest.distance, 2.0, kRounding);
  EXPECT_FALSE(nearest.is_minimum);
  EXPECT_LE(nearest.number, 1.0) << "never more than the smallest distance";
  EXPECT_NEAR(nearest.number, 1.0, 1e-9);
  scene.pairs.edit(0).settings.tracker.cutoff = std::numeric_limits<double>::infinity();
  scene.pairs.edit(1).settings.tracker.cutoff = 0.5;  // a/c, farther than a/b: no doubt
  EXPECT_TRUE(answer().is_minimum);
}

TEST_F(NearestTest, TheNumberIsTheBoundOfAProofThatEndedEarly) {
  DistanceCycle cycle(buffer, {"world", 1.0, 1});
  cycle.setScene(scene);
  cycle.run({kDistance, kDistance}, now);
  const auto tracked = std::make_shared<TrackedPair>(scene, 1, 0);  // a/c
  tracked->state = PairState::Solved;
  tracked->demand = kDistance;
  cycle.pairs()[1]->tracked = tracked;
  PairSolution& solution = tracked->solution;
  solution.distance = 1.5;
  solution.lower_bound = 0.25;
  for (const SolveStatus status :
       {SolveStatus::BudgetExhausted, SolveStatus::MemoryExhausted, SolveStatus::WithinTolerance}) {
    solution.status = status;
    const Nearest nearest = nearestOf(cycle.pairs(), cycle.others(), "world", now);
    EXPECT_EQ(nearest.pair, "a/b");
    EXPECT_FALSE(nearest.is_minimum) << "a/c may be nearer";
    EXPECT_EQ(nearest.number, 0.25) << toString(status);
    EXPECT_EQ(nearest.lower_bound, 0.25);
  }
}

TEST_F(NearestTest, SaysThatNoPairIsWatched) {
  const Nearest nearest = nearestOf({}, {}, "world", now);
  EXPECT_FALSE(nearest.has_distance);
  EXPECT_FALSE(nearest.has_number);
  EXPECT_FALSE(nearest.has_lower_bound);
  EXPECT_NE(nearest.message, "");
}

}  // namespace
}  // namespace concave_distance::nearest_test
