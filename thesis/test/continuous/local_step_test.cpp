#include "thesis/src/continuous/local_step.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random_engine.h"
#include "support/plain_shapes.h"
#include "thesis/test/continuous/tree_shapes.h"

namespace concave_distance::local_step_test {
namespace {

using test::boxTree;
using test::pitWithPost;

/// Two unit cubes, B's frame turned about z by a quarter and B one metre beyond A along x.
class TwoCubes : public ::testing::Test {
 protected:
  static Eigen::Isometry3d pose() {
    Eigen::Isometry3d a_from_b = Eigen::Isometry3d::Identity();
    a_from_b.linear() = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    a_from_b.translation() = Eigen::Vector3d(3, 0, 0);
    return a_from_b;
  }
  ConstraintTree a = boxTree({0, 0, 0}, {1, 1, 1});
  ConstraintTree b = boxTree({0, 0, 0}, {1, 1, 1});
  ContinuousObjective objective{a, b, pose(), 10.0};
  ContinuousCost cost;

  ContinuousPoint at(const Eigen::Vector3d& in_a, const Eigen::Vector3d& b_in_a) {
    return objective.evaluate(in_a, pose().inverse() * b_in_a, cost);
  }
};

TEST_F(TwoCubes, ObjectiveIsSquaredDistanceAndWeightedPenalty) {
  const ContinuousPoint inside = at({0.5, 0.5, 0.5}, {2.5, 0.5, 0.5});
  EXPECT_NEAR(inside.objective, 4.0, 1e-14);
  const ContinuousPoint outside = at({1.25, 0.5, 0.5}, {2.5, 0.5, 1.5});
  EXPECT_NEAR(outside.squared_distance, 1.25 * 1.25 + 1.0, 1e-14);
  EXPECT_NEAR(outside.objective, outside.squared_distance + 10.0 * (0.25 + 0.5), 1e-13);  // (2.4), (2.5)
  EXPECT_EQ(cost.evaluations, 2u);
  EXPECT_EQ(cost.constraints, 24u);
  EXPECT_EQ(cost.flops(), 2u * 26u + 24u * 6u);
}

TEST_F(TwoCubes, MoveCloserMovesEachPointByItsReach) {
  ContinuousPoint x = at({0.7, 0.5, 0.5}, {2.4, 0.5, 0.5});
  improveLocally(objective, {}, x, cost);
  EXPECT_TRUE(x.point_a.isApprox(Eigen::Vector3d(1.0, 0.5, 0.5), 1e-14));  // 0.3 from the wall
  EXPECT_TRUE((pose() * x.point_b).isApprox(Eigen::Vector3d(2.0, 0.5, 0.5), 1e-14));
  EXPECT_TRUE(x.isFeasible());
}

TEST_F(TwoCubes, RepairMovesAwayByOneAndAHalfTimesTheFurthestViolation) {
  ContinuousPoint x = at({1.2, 0.5, 0.5}, {2.2, 0.5, 0.5});
  improveLocally(objective, {}, x, cost);
  EXPECT_TRUE(x.point_a.isApprox(Eigen::Vector3d(0.9, 0.5, 0.5), 1e-14));
  EXPECT_TRUE(x.isFeasible());
}

TEST_F(TwoCubes, SafeRepairTakesBackWhatWorsensTheObjective) {
  // On the dark side: away from B is away from A, too (fig. 2.8, set 2).
  const ContinuousPoint before = at({-0.2, 0.5, 0.5}, {2.2, 0.5, 0.5});
  ContinuousPoint x = before;
  improveLocally(objective, {}, x, cost);
  EXPECT_EQ(x.point_a, before.point_a);
  LocalStepParameters unsafe;
  unsafe.repair = RepairMethod::MoveAway;
  improveLocally(objective, unsafe, x, cost);
  EXPECT_TRUE(x.point_a.isApprox(Eigen::Vector3d(-0.5, 0.5, 0.5), 1e-14));
}

TEST_F(TwoCubes, ProjectionBringsADarkPointBack) {
  ContinuousPoint x = at({-0.2, 0.5, 0.5}, {2.2, 0.5, 0.5});
  LocalStepParameters project;
  project.repair = RepairMethod::Project;
  improveLocally(objective, project, x, cost);
  EXPECT_TRUE(x.isFeasible());
  EXPECT_NEAR(x.point_a.x(), 0.0, 1e-9);
}

TEST_F(TwoCubes, SlidingReachesTheMinimumFromAnywhereInside) {
  LocalStepParameters slide;
  slide.move = LocalMove::SlideCloser;
  slide.repair = RepairMethod::Project;
  slide.repeats = 60;
  RandomEngine engine(4);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d in_a = Eigen::Vector3d::Constant(0.5) + test::uniformInCube(engine, 0.5);
    const Eigen::Vector3d in_b = Eigen::Vector3d::Constant(0.5) + test::uniformInCube(engine, 0.5);
    ContinuousPoint x = objective.evaluate(in_a, in_b, cost);
    improveLocally(objective, slide, x, cost);
    EXPECT_TRUE(x.isFeasible());
    EXPECT_NEAR(std::sqrt(x.squared_distance), 1.0, 1e-6);
  }
}

TEST(LocalStep, NeverWorsensTheObjective) {
  const ConstraintTree a = pitWithPost();
  const ConstraintTree b = boxTree({-0.4, -0.4, -1}, {0.4, 0.4, 1});
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  pose.translation() = Eigen::Vector3d(2, 2, 3.5);
  const ContinuousObjective objective(a, b, pose, 10.0);
  ContinuousCost cost;
  RandomEngine engine(5);
  for (const LocalMove move : {LocalMove::MoveCloser, LocalMove::SlideCloser}) {
    for (const RepairMethod repair : {RepairMethod::SafeMoveAway, RepairMethod::Project}) {
      LocalStepParameters parameters;
      parameters.move = move;
      parameters.repair = repair;
      int improved = 0;
      for (int i = 0; i < 500; ++i) {
        const Eigen::Vector3d in_a = Eigen::Vector3d::Constant(2.0) + test::uniformInCube(engine, 2.5);
        ContinuousPoint x = objective.evaluate(in_a, test::uniformInCube(engine, 1.2), cost);
        const double before = x.objective;
        improveLocally(objective, parameters, x, cost);
        EXPECT_LE(x.objective, before);
        improved += x.objective < before ? 1 : 0;
      }
      EXPECT_GT(improved, 50);
    }
  }
}

TEST(LocalStep, PointsThatMeetDoNotPassEachOther) {
  const ConstraintTree cube = boxTree({0, 0, 0}, {1, 1, 1});
  const ContinuousObjective objective(cube, cube, Eigen::Isometry3d::Identity(), 10.0);
  ContinuousCost cost;
  ContinuousPoint x = objective.evaluate({0.45, 0.5, 0.5}, {0.55, 0.5, 0.5}, cost);
  improveLocally(objective, {}, x, cost);
  EXPECT_NEAR(x.squared_distance, 0.0, 1e-30);
}

}  // namespace
}  // namespace concave_distance::local_step_test
