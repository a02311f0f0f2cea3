#include "distance/kernels/pair_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/body_pairs.h"

namespace concave_distance::pair_motion_test {
namespace {

using detail::PairMotion;
using Eigen::Isometry3d;
using Eigen::Vector3d;

TEST(PairMotion, IsTheTranslationWithoutTurning) {
  const Eigen::AlignedBox3d box(Vector3d(-1.0, -2.0, -3.0), Vector3d(1.0, 2.0, 3.0));
  const PairMotion motion(Isometry3d::Identity(), Isometry3d(Eigen::Translation3d(0.3, 0.0, 0.4)));
  EXPECT_DOUBLE_EQ(motion.largestIn(box), 0.5);
  EXPECT_DOUBLE_EQ(motion.largestWithin(Vector3d(7.0, 8.0, 9.0), 2.0), 0.5);
  EXPECT_FALSE(motion.isStill());
}

TEST(PairMotion, IsTheChordOfTheFarthestCornerWhenTurning) {
  const Eigen::AlignedBox3d box(Vector3d(-1.0, -2.0, -3.0), Vector3d(1.0, 2.0, 3.0));
  const PairMotion motion(Isometry3d::Identity(), Isometry3d(Eigen::AngleAxisd(0.2, Vector3d::UnitZ())));
  EXPECT_NEAR(motion.largestIn(box), 2.0 * std::sqrt(5.0) * std::sin(0.1), 1e-14);
  EXPECT_NEAR(motion.stretch(), 2.0 * std::sin(0.1), 1e-15);
  EXPECT_NEAR(motion.angle(), 0.2, 1e-15);
}

TEST(PairMotion, OfNoMotionIsStill) {
  const Isometry3d pose(Eigen::AngleAxisd(0.2, Vector3d::UnitZ()));
  EXPECT_TRUE(PairMotion(pose, pose).isStill());
}

// In long double no point moves farther than the bound, from turns of 1e-12 to half turns.
TEST(PairMotion, NoPointMovesFarther) {
  RandomEngine engine(11);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  using LongVector = Eigen::Matrix<long double, 3, 1>;
  for (int i = 0; i < 2000; ++i) {
    const double angle = std::pow(10.0, -6.0 + 6.5 * unit(engine));
    const Vector3d axis = Vector3d(unit(engine), unit(engine), unit(engine)).normalized();
    const Isometry3d before = test::randomPose(engine, 1.0);
    Isometry3d after = before;
    after.linear() = (Eigen::AngleAxisd(angle, axis) * before.linear()).matrix();
    after.translation() += angle * Vector3d(unit(engine), unit(engine), unit(engine));
    const double rounding = 1e-15;
    const PairMotion motion(before.linear(), before.translation(), after.linear(), after.translation(),
                            rounding);
    const Vector3d centre(unit(engine), unit(engine), unit(engine));
    const double radius = std::abs(unit(engine));
    const Eigen::AlignedBox3d box(centre - Vector3d::Constant(radius), centre + Vector3d::Constant(radius));
    for (int k = 0; k < 20; ++k) {
      const Vector3d direction(unit(engine), unit(engine), unit(engine));
      const auto moved = [&](const Vector3d& point) {
        const LongVector x = point.cast<long double>();
        return static_cast<double>(
            ((after.linear().cast<long double>() * x + after.translation().cast<long double>()) -
             (before.linear().cast<long double>() * x + before.translation().cast<long double>()))
                .norm());
      };
      ASSERT_LE(moved(centre + radius * direction.normalized()), motion.largestWithin(centre, radius)) << i;
      ASSERT_LE(moved(centre + radius * direction), motion.largestIn(box)) << i;
    }
  }
}

}  // namespace
}  // namespace concave_distance::pair_motion_test
