#include "kinematics/displacement_bound.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "concave_distance/kinematics/clearance.h"
#include "support/robots.h"
#include "support/scene_fixture.h"

namespace concave_distance::displacement_bound_test {
namespace {

using detail::BodyPath;
using detail::BoxCorners;
using detail::DisplacementBound;
using detail::MotionPaths;
using detail::MotionSpan;
using detail::RelativePath;
using detail::RelativePose;

BoxCorners box(const Eigen::Vector3d& half_extents, const Eigen::Vector3d& centre = Eigen::Vector3d::Zero()) {
  BodyBounds bounds;
  bounds.centre = centre;
  bounds.half_extents = half_extents;
  return detail::cornersOf(bounds);
}

/// A chain of revolute and prismatic joints with long offsets and a mimic, and a second branch.
std::string chainRobot(int joints, std::mt19937& engine) {
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  const auto triple = [&] {
    return std::to_string(number(engine)) + " " + std::to_string(number(engine)) + " " +
           std::to_string(number(engine));
  };
  std::string text = test::boxLink("l0");
  for (int i = 0; i < joints; ++i) {
    // The first is turning and has two branches; each third mimics the one before it.
    const std::string parent = "l" + std::to_string(i == 0 ? 0 : i % 4 == 3 ? i - 2 : i);
    const bool mimics = i % 3 == 2;
    text += test::boxLink("l" + std::to_string(i + 1));
    text += test::movingJoint(
        "j" + std::to_string(i), i % 4 == 2 ? "prismatic" : "revolute", parent, "l" + std::to_string(i + 1),
        "<origin xyz='" + triple() + "' rpy='" + triple() + "'/><axis xyz='" + triple() + "'/>" +
            (mimics ? "<mimic joint='j" + std::to_string(i - 1) + "' multiplier='-1.5' offset='0.1'/>" : ""));
  }
  return test::robot(text);
}

class DisplacementBoundTest : public test::SceneTest {
 protected:
  /// A motion through random positions of all joints. @param degree 1, 3 or 5
  void setMotion(const std::string& urdf, std::size_t waypoints, int degree, std::mt19937& engine) {
    scene = loadRobot(urdf);
    const SceneKinematics joints(scene);
    JointMotion motion;
    motion.joints = joints.positionNames();
    const auto rows = static_cast<Eigen::Index>(waypoints);
    const auto columns = static_cast<Eigen::Index>(motion.joints.size());
    motion.positions.resize(rows, columns);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    for (Eigen::Index row = 0; row < rows; ++row) {
      motion.times.push_back(0.7 * static_cast<double>(row));
      motion.positions.row(row) = test::randomPositions(*joints.robots().front(), engine).transpose();
    }
    const auto random = [&] {
      return Eigen::MatrixXd(Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return number(engine); }));
    };
    if (degree > 1) motion.velocities = random();
    if (degree > 3) motion.accelerations = random();
    paths = detail::pathsOf(joints, joints.startState(), motion);
  }

  /// No two points of the boxes' borders come nearer or go farther than the bound allows, from either end.
  void requireBound(const BodyPath& a, const BodyPath& b, double from, double to, std::mt19937& engine) {
    const RelativePath path(paths, a, b);
    if (!path.isMoved()) return;
    const BoxCorners corners_a = box({0.3, 0.1, 0.05}, {0.1, 0.2, -0.1});
    const BoxCorners corners_b = box({0.05, 0.4, 0.1}, {-0.2, 0.0, 0.1});
    MotionSpan span;
    span.set(paths, path, from, to);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const auto corner = [](const BoxCorners& corners, int i) {
      return Eigen::Vector3d(corners.row(i % 8).matrix().transpose());
    };
    const auto borderPoint = [&](const BoxCorners& corners) {
      Eigen::Vector3d point = corner(corners, 0);
      for (int k = 0; k < 3; ++k) {
        const double share = k == 2 ? std::round(unit(engine)) : unit(engine);
        point += share * (corner(corners, 1 << k) - corner(corners, 0));
      }
      return point;
    };
    const std::array<double, 2> ends{from, to};
    std::array<RelativePose, 2> poses;
    std::array<DisplacementBound, 2> bounds;
    for (std::size_t i = 0; i < 2; ++i) {
      path.evaluate(paths, span.momentOf(ends[i]), poses[i]);
      bounds[i] = span.from(poses[i], corners_a, corners_b);
    }
    // Seen from one body, the acceleration of either end is that of the whole span.
    if (bounds[0].is_from_a == bounds[1].is_from_a) {
      bounds[0].acceleration = bounds[1].acceleration =
          std::min(bounds[0].acceleration, bounds[1].acceleration);
      ++seen_from_one;
    }
    for (std::size_t i = 0; i < 2; ++i) {
      const double end = ends[i];
      const RelativePose& at_end = poses[i];
      const DisplacementBound& bound = bounds[i];
      ASSERT_TRUE(std::isfinite(bound.way));
      for (int trial = 0; trial < 60; ++trial) {
        const double moment = trial == 0 ? from : trial == 1 ? to : from + unit(engine) * (to - from);
        RelativePose there;
        path.evaluate(paths, span.momentOf(moment), there);
        const Eigen::Vector3d point_a = trial % 2 == 0 ? borderPoint(corners_a) : corner(corners_a, trial);
        const Eigen::Vector3d point_b =
            trial % 2 == 0 ? borderPoint(corners_b) : corner(corners_b, trial / 8);
        const double before = (at_end.a_from_b * point_b - point_a).norm();
        const double after = (there.a_from_b * point_b - point_a).norm();
        const double change = std::abs(after - before) - 1e-12;
        ASSERT_LE(change, bound.way) << "from " << from << " to " << to << " at " << moment;
        if (!span.isInOneSegment()) continue;
        ASSERT_LE(change, bound.after(std::abs(moment - end))) << "from " << from << " to " << to;
        const double share = bound.shareOf(change);
        ASSERT_LE(share, std::abs(moment - end) + 1e-9);
        ++looked_at;
      }
    }
  }

  void requireBounds(int spans, std::mt19937& engine) {
    std::uniform_real_distribution<double> moment(0.0, paths.end());
    std::uniform_int_distribution<std::size_t> body(0, paths.bodies.size() - 1);
    for (int i = 0; i < spans; ++i) {
      const auto& a = paths.bodies[body(engine)];
      const auto& b = paths.bodies[body(engine)];
      if (&a == &b || !a || !b) continue;
      double from = moment(engine);
      double to =
          i % 3 == 0 ? moment(engine) : std::min(paths.end(), from + 0.1 * moment(engine) / paths.end());
      if (i % 5 == 0) from = std::floor(from);
      if (i % 5 == 1) to = std::ceil(to);
      if (from > to) std::swap(from, to);
      requireBound(*a, *b, from, to, engine);
      if (HasFatalFailure()) return;
    }
  }

  Scene scene;
  MotionPaths paths;
  int looked_at = 0;
  int seen_from_one = 0;
};

TEST_F(DisplacementBoundTest, HoldsForRandomChains) {
  std::mt19937 engine(3);
  for (int trial = 0; trial < 12; ++trial) {
    setMotion(chainRobot(2 + trial % 6, engine), 4, 1 + 2 * (trial % 3), engine);
    requireBounds(60, engine);
  }
  EXPECT_GT(looked_at, 10000);
  EXPECT_GT(seen_from_one, 100);
}

TEST_F(DisplacementBoundTest, HoldsForEveryTypeOfJoint) {
  std::mt19937 engine(4);
  for (int degree = 1; degree <= 5; degree += 2) {
    setMotion(test::mobileRobot(), 4, degree, engine);
    requireBounds(200, engine);
  }
  EXPECT_GT(looked_at, 10000);
}

// A turning point at a known distance from the axis: the way is the arc, and nothing is given away.
TEST_F(DisplacementBoundTest, IsExactForOneTurn) {
  paths.times = {0.0, 1.0};
  paths.curves.push_back(detail::MotionCurve::straight({0.0, 0.5}));
  paths.elements.emplace_back().axes.col(0) = Eigen::Vector3d::UnitZ();
  const BodyPath still;
  const BodyPath turning{{0}, Eigen::Isometry3d::Identity(), Eigen::Isometry3d::Identity()};
  const RelativePath path(paths, still, turning);
  const BoxCorners point = box(Eigen::Vector3d::Zero(), {3.0, 4.0, 7.0});
  MotionSpan span;
  span.set(paths, path, 0.0, 1.0);
  RelativePose pose;
  path.evaluate(paths, span.momentOf(0.0), pose);
  const DisplacementBound bound = span.from(pose, point, point);
  EXPECT_NEAR(bound.way, 2.5, 1e-9);
  EXPECT_NEAR(bound.speed, 2.5, 1e-9);
}

// The fastest point is slower than the sum of what the joints do to it: two that turn against each other
// only shift what they carry.
TEST_F(DisplacementBoundTest, LetsJointsCancelInSmallSpans) {
  paths.times = {0.0, 1.0};
  paths.curves.push_back(detail::MotionCurve::straight({0.0, 1.0}));
  paths.curves.push_back(detail::MotionCurve::straight({0.0, -1.0}));
  for (std::size_t i = 0; i < 2; ++i) {
    detail::PathElement& element = paths.elements.emplace_back();
    element.axes.col(0) = Eigen::Vector3d::UnitZ();
    element.curve = i;
  }
  paths.elements[1].before.translation() = Eigen::Vector3d(0.1, 0.0, 0.0);
  const BodyPath carried{{0, 1}, Eigen::Isometry3d::Identity(), Eigen::Isometry3d::Identity()};
  const RelativePath path(paths, BodyPath(), carried);
  MotionSpan span;
  span.set(paths, path, 0.0, 0.01);
  RelativePose pose;
  path.evaluate(paths, span.momentOf(0.0), pose);
  const BoxCorners far = box({0.1, 0.1, 0.1}, {5.0, 0.0, 0.0});
  const BoxCorners near = box({0.1, 0.1, 0.1});
  EXPECT_NEAR(span.from(pose, near, far).after(0.01), 0.1 * 0.01, 1e-3);
}

}  // namespace
}  // namespace concave_distance::displacement_bound_test
