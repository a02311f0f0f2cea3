// Which boxes overlap, against every pair of them tried.
#include "scene/sweep_and_prune.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <utility>

namespace concave_distance::sweep_and_prune_test {
namespace {

using Pairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;
constexpr double kInfinite = std::numeric_limits<double>::infinity();

struct Box {
  Eigen::Vector3d lower;
  Eigen::Vector3d upper;
};
using Boxes = std::map<std::uint32_t, Box>;

Pairs bruteForce(const Boxes& boxes) {
  Pairs pairs;
  for (const auto& [i, a] : boxes) {
    for (const auto& [j, b] : boxes) {
      bool meet = i < j;
      for (int axis = 0; axis < 3; ++axis) {
        meet = meet && a.lower[axis] <= b.upper[axis] && b.lower[axis] <= a.upper[axis];
      }
      if (meet) pairs.emplace(i, j);
    }
  }
  return pairs;
}

Pairs setOf(const std::vector<SlotPair>& list) {
  Pairs pairs;
  for (const SlotPair pair : list) EXPECT_TRUE(pairs.emplace(pair.a, pair.b).second) << "reported twice";
  return pairs;
}

Pairs without(const Pairs& from, const Pairs& what) {
  Pairs left;
  std::set_difference(from.begin(), from.end(), what.begin(), what.end(), std::inserter(left, left.end()));
  return left;
}

/// Holds a sweep beside the boxes that it was given.
struct Scene {
  SweepAndPrune sweep;
  Boxes boxes;
  Pairs before;

  void set(std::uint32_t slot, const Box& box) {
    sweep.set(slot, box.lower, box.upper);
    boxes[slot] = box;
  }
  void remove(std::uint32_t slot) {
    sweep.remove(slot);
    boxes.erase(slot);
  }
  void check() {
    sweep.update();
    const Pairs expected = bruteForce(boxes);
    Pairs found;
    sweep.overlaps().visit([&](SlotPair pair) { found.emplace(pair.a, pair.b); });
    ASSERT_EQ(found, expected);
    ASSERT_EQ(sweep.overlaps().size(), expected.size());
    ASSERT_EQ(setOf(sweep.begun()), without(expected, before));
    ASSERT_EQ(setOf(sweep.ended()), without(before, expected));
    before = expected;
  }
};

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  std::uint32_t below(std::uint32_t n) {
    return std::uniform_int_distribution<std::uint32_t>(0, n - 1)(engine_);
  }
  Box box(double space, double size) {
    const Eigen::Vector3d lower(between(0, space), between(0, space), between(0, space));
    return {lower, lower + Eigen::Vector3d(between(0, size), between(0, size), between(0, size))};
  }
  /// Corners on a coarse grid: many coordinates are equal, many boxes touch or are flat.
  Box gridBox() {
    const Eigen::Vector3d lower(below(6), below(6), below(6));
    return {lower, lower + Eigen::Vector3d(below(3), below(3), below(3))};
  }

 private:
  std::mt19937 engine_;
};

TEST(SweepAndPrune, FollowsBoxesThatMoveALittle) {
  Random random(1);
  Scene scene;
  for (std::uint32_t slot = 0; slot < 80; ++slot) scene.set(slot, random.box(4.0, 1.0));
  std::uint64_t most_swaps = 0;
  for (int step = 0; step < 200; ++step) {
    if (step > 0) {
      for (auto& [slot, box] : Boxes(scene.boxes)) {
        const Eigen::Vector3d by(random.between(-0.02, 0.02), random.between(-0.02, 0.02), 0.01);
        scene.set(slot, {box.lower + by, box.upper + by});
      }
    }
    scene.check();
    most_swaps = std::max(most_swaps, scene.sweep.swaps());
  }
  EXPECT_GT(most_swaps, 0U) << "neighbours were swapped, not everything sorted anew";
}

TEST(SweepAndPrune, FollowsBoxesThatAppearVanishAndJump) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    Scene scene;
    for (int step = 0; step < 60; ++step) {
      const std::uint32_t changes = step % 7 == 0 ? 70 : 5;
      for (std::uint32_t k = 0; k < changes; ++k) {
        const std::uint32_t slot = random.below(100);
        if (random.below(4) == 0) {
          scene.remove(slot);
        } else {
          scene.set(slot, random.box(3.0, 1.0));
        }
      }
      scene.check();
    }
  }
}

TEST(SweepAndPrune, CountsTouchingFlatAndEqualBoxesAsOverlapping) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    Scene scene;
    for (int step = 0; step < 40; ++step) {
      for (int k = 0; k < 6; ++k) scene.set(random.below(40), random.gridBox());
      if (step % 5 == 4) scene.remove(random.below(40));
      scene.check();
    }
  }
}

TEST(SweepAndPrune, TakesBoxesWithoutEnd) {
  Random random(3);
  Scene scene;
  const Eigen::Vector3d everywhere = Eigen::Vector3d::Constant(kInfinite);
  for (std::uint32_t slot = 0; slot < 20; ++slot) scene.set(slot, random.box(9.0, 1.0));
  scene.check();
  scene.set(4, {-everywhere, everywhere});
  scene.set(7, {Eigen::Vector3d(-kInfinite, 0, 0), Eigen::Vector3d(kInfinite, 1, 1)});
  scene.check();
  EXPECT_GE(scene.before.size(), 19U);
  scene.set(4, random.box(9.0, 1.0));
  scene.remove(7);
  scene.check();
}

TEST(SweepAndPrune, LeavesOutABoxThatIsNoNumberOrEndsBeforeItBegins) {
  Scene scene;
  const Box unit{Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones()};
  for (std::uint32_t slot = 0; slot < 3; ++slot) scene.set(slot, unit);
  scene.check();
  ASSERT_EQ(scene.before.size(), 3U);
  Eigen::Vector3d bad = Eigen::Vector3d::Zero();
  bad.y() = std::numeric_limits<double>::quiet_NaN();
  scene.sweep.set(1, bad, unit.upper);
  scene.boxes.erase(1);
  scene.check();
  scene.sweep.set(2, unit.upper, unit.lower);
  scene.boxes.erase(2);
  scene.check();
  EXPECT_TRUE(scene.before.empty());
  scene.set(1, unit);
  scene.check();
  EXPECT_EQ(scene.before.size(), 1U);
}

TEST(SweepAndPrune, ForgetsEverythingWhenCleared) {
  Scene scene;
  const Box unit{Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones()};
  scene.set(0, unit);
  scene.set(1, unit);
  scene.check();
  scene.sweep.clear();
  scene.boxes.clear();
  scene.before.clear();
  scene.check();
  scene.set(1, unit);
  scene.set(5, unit);
  scene.check();
  EXPECT_EQ(scene.before.size(), 1U);
}

}  // namespace
}  // namespace concave_distance::sweep_and_prune_test
