#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "thesis/src/continuous/continuous_mating.h"
#include "thesis/src/continuous/random_moves.h"

namespace concave_distance::continuous_operators_test {
namespace {

const Eigen::AlignedBox3d kBoxA(Eigen::Vector3d(-1, 0, 2), Eigen::Vector3d(1, 4, 3));
const Eigen::AlignedBox3d kBoxB(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0.5, 0.25, 8));

TEST(RandomMoves, StartsFillBothBoxes) {
  RandomEngine engine(1);
  Eigen::AlignedBox3d seen_a;
  Eigen::AlignedBox3d seen_b;
  for (int i = 0; i < 2000; ++i) {
    const PointPair x = randomPair(kBoxA, kBoxB, engine);
    EXPECT_TRUE(kBoxA.contains(x.point_a) && kBoxB.contains(x.point_b));
    seen_a.extend(x.point_a);
    seen_b.extend(x.point_b);
  }
  EXPECT_GT(seen_a.volume(), 0.98 * kBoxA.volume());
  EXPECT_GT(seen_b.volume(), 0.98 * kBoxB.volume());
}

TEST(RandomMoves, CartesianMoveChangesOneCoordinateWithinItsBox) {
  RandomEngine engine(2);
  const PointPair x{{0, 1, 2.5}, {0.1, 0.1, 7}};
  int changes[6] = {};
  for (int i = 0; i < 6000; ++i) {
    const PointPair moved = moveRandomly(RandomMove::Cartesian, x, kBoxA, kBoxB, 1.0, engine);
    EXPECT_TRUE(kBoxA.contains(moved.point_a) && kBoxB.contains(moved.point_b));
    int changed = 0;
    for (int axis = 0; axis < 3; ++axis) {
      changes[axis] += moved.point_a[axis] != x.point_a[axis] ? 1 : 0;
      changes[axis + 3] += moved.point_b[axis] != x.point_b[axis] ? 1 : 0;
      changed +=
          (moved.point_a[axis] != x.point_a[axis] ? 1 : 0) + (moved.point_b[axis] != x.point_b[axis] ? 1 : 0);
    }
    EXPECT_EQ(changed, 1);
  }
  // 1000 expected, standard deviation 29: five of them.
  for (const int count : changes) EXPECT_NEAR(count, 1000, 145);
}

TEST(RandomMoves, VariableDisplacementScalesTheSameDraw) {
  const PointPair x{{0, 1, 2.5}, {0.1, 0.1, 7}};
  for (const RandomMove move : {RandomMove::Cartesian, RandomMove::RandomDirection}) {
    RandomEngine fixed(3);
    RandomEngine scaled(3);
    for (int i = 0; i < 100; ++i) {
      const PointPair whole = moveRandomly(move, x, kBoxA, kBoxB, 1.0, fixed);
      const PointPair part = moveRandomly(move, x, kBoxA, kBoxB, 0.25, scaled);
      EXPECT_LT((part.point_a - x.point_a - 0.25 * (whole.point_a - x.point_a)).norm(),
                1e-14);  // (2.12), (2.13)
      EXPECT_LT((part.point_b - x.point_b - 0.25 * (whole.point_b - x.point_b)).norm(), 1e-14);
    }
  }
}

TEST(RandomMoves, RandomDirectionReachesHalfTheDiagonalAndNoFarther) {
  RandomEngine engine(4);
  const PointPair x{{0, 0, 0}, {0, 0, 0}};
  double farthest_a = 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < 4000; ++i) {
    const PointPair moved = moveRandomly(RandomMove::RandomDirection, x, kBoxA, kBoxB, 1.0, engine);
    farthest_a = std::max(farthest_a, moved.point_a.norm());
    EXPECT_LE(moved.point_b.norm(), 0.5 * kBoxB.diagonal().norm());
    sum += moved.point_a;
  }
  const double reach = 0.5 * kBoxA.diagonal().norm();
  EXPECT_LE(farthest_a, reach);
  EXPECT_GT(farthest_a, 0.99 * reach);
  EXPECT_LT(sum.norm() / 4000, 0.1) << "no direction is preferred";
}

TEST(BoltzmannFactor, FollowsEquation26AndIsOneOnImprovement) {
  EXPECT_DOUBLE_EQ(boltzmannFactor(1.0, 2.0, 0.0005, 5000.0), std::exp(-1.0 / 2.5));
  EXPECT_EQ(boltzmannFactor(2.0, 1.0, 0.0005, 5000.0), 1.0);
  EXPECT_EQ(boltzmannFactor(2.0, 1.0, 0.0005, 0.0), 1.0);
  EXPECT_EQ(boltzmannFactor(1.0, 2.0, 0.0005, 0.0), 0.0);
}

ContinuousPoint parent(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double objective) {
  ContinuousPoint x;
  x.point_a = a;
  x.point_b = b;
  x.objective = objective;
  return x;
}

/// Where a point stands on the way from one to another, and that it stands on it.
double shareOf(const Eigen::Vector3d& point, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const double share = (point - from).dot(to - from) / (to - from).squaredNorm();
  EXPECT_LT((from + share * (to - from) - point).norm(), 1e-13);
  return share;
}

TEST(ContinuousMating, LinearScalingPutsChildrenAnywhereBetweenTheParents) {
  RandomEngine engine(5);
  const ContinuousPoint mother = parent({0, 0, 0}, {1, 1, 1}, 3.0);
  const ContinuousPoint father = parent({1, 2, 3}, {-1, 0, 5}, 1.0);
  double low = 1.0;
  double high = 0.0;
  for (int i = 0; i < 500; ++i) {
    const auto [first, second] = mateContinuous(ContinuousMating::LinearScaling, mother, father, engine);
    for (const PointPair& child : {first, second}) {
      for (const double share : {shareOf(child.point_a, mother.point_a, father.point_a),
                                 shareOf(child.point_b, mother.point_b, father.point_b)}) {
        EXPECT_GE(share, -1e-14);
        EXPECT_LE(share, 1.0 + 1e-14);
        low = std::min(low, share);
        high = std::max(high, share);
      }
    }
    EXPECT_NE(first.point_a, second.point_a);
  }
  EXPECT_LT(low, 0.02);
  EXPECT_GT(high, 0.98);
}

TEST(ContinuousMating, FitnessWeightedPutsTheFirstChildWhereEquation215Says) {
  RandomEngine engine(6);
  const ContinuousPoint mother = parent({0, 0, 0}, {1, 1, 1}, 3.0);
  const ContinuousPoint father = parent({1, 2, 3}, {-1, 0, 5}, 1.0);
  for (int i = 0; i < 100; ++i) {
    const auto [first, second] = mateContinuous(ContinuousMating::FitnessWeighted, mother, father, engine);
    EXPECT_NEAR(shareOf(first.point_a, mother.point_a, father.point_a), 0.75, 1e-14);
    EXPECT_NEAR(shareOf(first.point_b, mother.point_b, father.point_b), 0.75, 1e-14);
    const double share = shareOf(second.point_a, mother.point_a, father.point_a);
    EXPECT_GE(share, 0.75 - 1e-14) << "between the first child and the better parent";
    EXPECT_LE(share, 1.0);
    const auto twice = mateContinuous(ContinuousMating::FitnessWeightedTwice, mother, father, engine);
    EXPECT_EQ(twice.first.point_a, first.point_a);
    EXPECT_EQ(twice.first.point_b, first.point_b);
    EXPECT_EQ(twice.second.point_a, first.point_a);
    EXPECT_EQ(twice.second.point_b, first.point_b);
  }
}

TEST(ContinuousMating, FitnessWeightedIsDefinedWhereBothParentsArePerfect) {
  RandomEngine engine(7);
  const ContinuousPoint mother = parent({0, 0, 0}, {0, 0, 0}, 0.0);
  const ContinuousPoint father = parent({2, 0, 0}, {0, 2, 0}, 0.0);
  const auto [first, second] = mateContinuous(ContinuousMating::FitnessWeighted, mother, father, engine);
  EXPECT_EQ(first.point_a, Eigen::Vector3d(1, 0, 0));
  EXPECT_TRUE(second.point_b.allFinite());
}

}  // namespace
}  // namespace concave_distance::continuous_operators_test
