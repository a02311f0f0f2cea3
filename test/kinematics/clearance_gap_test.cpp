#include "kinematics/clearance_gap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace concave_distance::clearance_gap_test {
namespace {

using detail::BodyPath;
using detail::ClearanceBody;
using detail::ClearanceGap;
using detail::ClearancePair;
using detail::ClearanceSample;
using detail::MotionCurve;
using detail::MotionPaths;
using detail::PathElement;
using detail::RelativePath;
using detail::RelativePose;
using Eigen::Vector3d;

constexpr double kRounding = 1e-12;  // metres, of motions of some metres

/// Two bodies, each moved by turns and slides on cubics.
class ClearanceGapTest : public ::testing::Test {
 protected:
  double number() { return std::uniform_real_distribution<double>(-1.0, 1.0)(engine); }
  Vector3d triple() { return {number(), number(), number()}; }

  void setMotion() {
    paths = MotionPaths();
    paths.times = {0.0, 1.0};
    a = randomBody();
    b = randomBody();
  }

  ClearanceBody randomBody() {
    ClearanceBody body;
    const int count = std::uniform_int_distribution<int>(1, 3)(engine);
    for (int i = 0; i < count; ++i) {
      body.path.elements.push_back(paths.elements.size());
      PathElement& element = paths.elements.emplace_back();
      element.kind = i == 1 ? PathElement::Kind::Slide : PathElement::Kind::Turn;
      element.before.translation() = triple();
      element.axes.col(0) = triple().normalized();
      element.curve = paths.curves.size();
      paths.curves.emplace_back(
          std::vector<MotionCurve::Coefficients>{{number(), number(), number(), number()}}, 3);
    }
    body.bounds.centre = triple();
    body.bounds.half_extents = 0.5 * triple().cwiseAbs();
    body.corners = detail::cornersOf(body.bounds);
    return body;
  }

  Vector3d pointOf(const ClearanceBody& body) {
    return body.bounds.centre + body.bounds.half_extents.cwiseProduct(triple());
  }

  std::mt19937 engine{11};
  MotionPaths paths;
  ClearanceBody a;
  ClearanceBody b;
};

// Where both ends prove the same, by bisection: what the left one proves falls, what the right one proves
// rises.
double leastOfEnds(const ClearanceGap& gap) {
  const double length = gap.right.moment - gap.left.moment;
  const auto left = [&](double along) { return gap.left.lower - gap.from_left.after(along); };
  const auto right = [&](double along) { return gap.right.lower - gap.from_right.after(length - along); };
  double from = 0.0;
  double to = length;
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (from + to);
    (left(middle) > right(middle) ? from : to) = middle;
  }
  return std::max(left(from), right(from));
}

// The ends prove what two points say that are just as far apart there.
TEST_F(ClearanceGapTest, ProvesNoMoreThanPointsInTheBoxesAllowAndThanItsEnds) {
  int from_two_bodies = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    if (trial % 10 == 0) setMotion();
    const ClearancePair pair{0, 1, &a, &b, 0.0, 0.0, RelativePath(paths, a.path, b.path)};
    const Vector3d point_a = pointOf(a);
    const Vector3d point_b = pointOf(b);
    const auto distanceAt = [&](double moment) {
      RelativePose pose;
      pair.path.evaluate(paths, detail::momentAt(moment, 1), pose);
      return (pose.a_from_b * point_b - point_a).norm();
    };
    const auto sample = [&](double moment) {
      ClearanceSample end;
      end.moment = moment;
      end.lower = distanceAt(moment);
      return end;
    };
    const double middle = 0.5 + 0.25 * number();
    const double half = 0.25 * std::pow(number(), 2);
    detail::ClearanceWorkspace workspace;
    const ClearanceGap gap =
        detail::gapBetween(paths, pair, 0, sample(middle - half), sample(middle + half), workspace);
    for (int k = 0; k <= 10; ++k) {
      const double moment = middle + half * (0.2 * k - 1.0);
      ASSERT_GE(distanceAt(moment), gap.lower - kRounding) << "trial " << trial << " at " << moment;
    }
    // Seen from one body the ends share the smaller acceleration, seen from two they must not.
    if (gap.from_left.is_from_a == gap.from_right.is_from_a) continue;
    const double by_way =
        0.5 * (gap.left.lower + gap.right.lower - std::min(gap.from_left.way, gap.from_right.way));
    ASSERT_LE(gap.lower, std::max(by_way, leastOfEnds(gap)) + kRounding) << "trial " << trial;
    if (gap.lower > by_way) ++from_two_bodies;
  }
  EXPECT_GT(from_two_bodies, 100);
}

}  // namespace
}  // namespace concave_distance::clearance_gap_test
