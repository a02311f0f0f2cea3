#include "thesis/src/continuous/feasibility.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/random_engine.h"
#include "support/plain_shapes.h"
#include "thesis/test/continuous/tree_shapes.h"

namespace concave_distance::feasibility_test {
namespace {

using test::boxPiece;
using test::pitWithPost;

Eigen::Vector3d pointAround(RandomEngine& engine) {
  return Eigen::Vector3d::Constant(2.0) + test::uniformInCube(engine, 2.5);
}

TEST(Feasibility, IsTheBodyAtEveryPoint) {
  const ConstraintTree tree = pitWithPost();
  RandomEngine engine(1);
  int inside = 0;
  for (int i = 0; i < 20000; ++i) {
    const Eigen::Vector3d p = pointAround(engine);
    EXPECT_EQ(evaluatePoint(tree, p).is_feasible, test::insidePitWithPost(p)) << p.transpose();
    inside += test::insidePitWithPost(p) ? 1 : 0;
  }
  EXPECT_GT(inside, 5000);
}

TEST(Feasibility, WallsBelongToTheBodyAndMouthsDoNot) {
  const ConstraintTree tree = pitWithPost();
  EXPECT_TRUE(evaluatePoint(tree, {1, 2, 3}).is_feasible) << "wall of the pit";
  EXPECT_TRUE(evaluatePoint(tree, {1.2, 1.2, 1}).is_feasible) << "floor of the pit";
  EXPECT_TRUE(evaluatePoint(tree, {2, 2, 2}).is_feasible) << "top of the post";
  EXPECT_TRUE(evaluatePoint(tree, {4, 4, 4}).is_feasible) << "corner of the cube";
  EXPECT_FALSE(evaluatePoint(tree, {2, 2, 4}).is_feasible) << "mouth of the pit: no lid";
}

TEST(Feasibility, HoldsWhereHullsOfSiblingsOverlap) {
  // Two pits whose hulls overlap, a post in one of them: where it stands within the other, it is air,
  // whatever the order (fig. 2.4 stops at the first concavity that holds the point).
  PieceDescription cube = boxPiece({0, 0, 0}, {4, 4, 4});
  PieceDescription with_post = boxPiece({1, 1, 1}, {3, 3, 3});
  with_post.children.push_back(boxPiece({1, 1, 1}, {2, 3, 3}));
  const PieceDescription plain = boxPiece({1.5, 1, 1}, {3.5, 3, 3});
  for (const bool post_first : {true, false}) {
    cube.children = post_first ? std::vector<PieceDescription>{with_post, plain}
                               : std::vector<PieceDescription>{plain, with_post};
    const ConstraintTree tree(cube, {Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(4)}, 1e-12,
                              "siblings");
    EXPECT_TRUE(evaluatePoint(tree, {1.25, 2, 2}).is_feasible) << "in the post only";
    EXPECT_FALSE(evaluatePoint(tree, {1.75, 2, 2}).is_feasible) << "in the post, but in the other pit, too";
    EXPECT_FALSE(evaluatePoint(tree, {2.5, 2, 2}).is_feasible) << "in both pits";
  }
}

TEST(Feasibility, PenaltyOutsideIsTheSumOfTheViolatedConstraints) {
  const ConstraintTree tree = pitWithPost();
  const PointState state = evaluatePoint(tree, {-1, 2, 6});
  EXPECT_FALSE(state.is_feasible);
  EXPECT_DOUBLE_EQ(state.violation, 3.0);  // (2.5)
  EXPECT_DOUBLE_EQ(state.reach, 2.0);      // the furthest violated constraint
  EXPECT_EQ(state.repair_direction, Eigen::Vector3d(0, 0, -1));
}

TEST(Feasibility, PenaltyInAConcavityIsTheWayToTheNearestWallOrSolid) {
  const ConstraintTree tree = pitWithPost();
  const PointState at_wall = evaluatePoint(tree, {1.1, 2, 3});
  EXPECT_NEAR(at_wall.violation, 0.1, 1e-15);
  EXPECT_EQ(at_wall.repair_direction, Eigen::Vector3d(-1, 0, 0));
  const PointState at_post = evaluatePoint(tree, {1.4, 2, 1.8});
  EXPECT_NEAR(at_post.violation, 0.1, 1e-15);
  EXPECT_EQ(at_post.repair_direction, Eigen::Vector3d(1, 0, 0));
}

TEST(Feasibility, PenaltyVanishesExactlyInTheBodyAndContinuously) {
  const ConstraintTree tree = pitWithPost();
  RandomEngine engine(2);
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d p = pointAround(engine);
    const Eigen::Vector3d q = p + test::uniformInCube(engine, 1e-6);
    const PointState at_p = evaluatePoint(tree, p);
    const PointState at_q = evaluatePoint(tree, q);
    EXPECT_EQ(at_p.violation == 0.0, at_p.is_feasible);
    // A sum of at most three distances, each changes no faster than the point.
    EXPECT_LE(std::abs(at_p.violation - at_q.violation), 3.0 * (p - q).norm() + 1e-14) << p.transpose();
  }
}

TEST(Feasibility, PointsMayMoveByTheirReach) {
  const ConstraintTree tree = pitWithPost();
  RandomEngine engine(3);
  int moved = 0;
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Vector3d p = pointAround(engine);
    const PointState state = evaluatePoint(tree, p);
    EXPECT_GE(state.reach, 0.0);
    const Eigen::Vector3d direction = test::uniformInCube(engine, 1.0).normalized();
    if (state.is_feasible) {
      EXPECT_TRUE(evaluatePoint(tree, p + 0.999999 * state.reach * direction).is_feasible) << p.transpose();
      moved += state.reach > 0.1 ? 1 : 0;
    }
  }
  EXPECT_GT(moved, 500);
}

TEST(Feasibility, CountsTheConstraintsOfTheWalk) {
  const ConstraintTree tree = pitWithPost();
  EXPECT_EQ(evaluatePoint(tree, {5, 0, 0}).constraints_evaluated, 6u);
  EXPECT_EQ(evaluatePoint(tree, {0.5, 0.5, 0.5}).constraints_evaluated, 11u);
  EXPECT_EQ(evaluatePoint(tree, {2, 2, 3}).constraints_evaluated, 17u);
}

}  // namespace
}  // namespace concave_distance::feasibility_test
