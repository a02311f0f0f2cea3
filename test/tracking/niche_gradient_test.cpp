#include "concave_distance/tracking/niche_gradient.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "concave_distance/mesh/surface/primitives.h"
#include "concave_distance/tracking/pair_tracker.h"

namespace concave_distance::niche_gradient_test {
namespace {

constexpr double kStep = 1e-6;

std::shared_ptr<const BodyMesh> boxOf(const Eigen::Vector3d& size) {
  return std::make_shared<const BodyMesh>("box", makeBox(size), BodyMeshOptions{});
}

/// The motion of a body along one component of a twist about A's origin, for a short time.
Eigen::Isometry3d step(int component, double seconds) {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d axis = Eigen::Vector3d::Unit(component % 3);
  if (component < 3) motion.translation() = seconds * axis;
  if (component >= 3) motion.linear() = Eigen::AngleAxisd(seconds, axis).toRotationMatrix();
  return motion;
}

TEST(NicheGradient, IsTheDifferenceOfDistancesByTheTwistsOfBothBodies) {
  const auto a = boxOf({1.0, 0.6, 0.4});
  const auto b = boxOf({0.5, 0.7, 0.9});
  std::mt19937 engine(1);
  std::normal_distribution<double> normal(0.0, 1.0);
  TrackerParameters parameters;
  parameters.niches_wanted = true;
  int compared = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const Eigen::Vector3d to_b = Eigen::Vector3d(normal(engine), normal(engine), normal(engine)).normalized();
    const Eigen::Quaterniond turn(normal(engine), normal(engine), normal(engine), normal(engine));
    const Eigen::Isometry3d pose = Eigen::Translation3d(2.0 * to_b) * turn.normalized();
    const PairSolution solution = solveOnce("boxes", a, b, parameters, pose);
    ASSERT_FALSE(solution.niches.empty());
    const DistanceGradient gradient = gradientOf(solution.niches.front());
    const auto distance = [&](const Eigen::Isometry3d& moved) {
      return solveOnce("boxes", a, b, parameters, moved).distance;
    };
    for (int component = 0; component < 6; ++component) {
      const Eigen::Isometry3d ahead = step(component, kStep);
      const Eigen::Isometry3d behind = step(component, -kStep);
      const double by_b = (distance(ahead * pose) - distance(behind * pose)) / (2.0 * kStep);
      const double by_a =
          (distance(ahead.inverse() * pose) - distance(behind.inverse() * pose)) / (2.0 * kStep);
      // Near a change of features a difference is off by a step times the jump of the curvature.
      EXPECT_NEAR(gradient.by_b[component], by_b, 2.0 * kStep) << trial << " " << component;
      EXPECT_NEAR(gradient.by_a[component], by_a, 2.0 * kStep) << trial << " " << component;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 600);
}

}  // namespace
}  // namespace concave_distance::niche_gradient_test
