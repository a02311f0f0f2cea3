// Distances of exact round solids: kernels against a search in long double, pairs against closed forms,
// proofs against every triangle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "distance/bound/round_certificate.h"
#include "distance/kernels/round_kernels.h"
#include "distance/kernels/round_pair_distance.h"
#include "mesh/surface/round_geometry.h"
#include "support/body_pairs.h"
#include "support/round_bodies.h"
#include "support/wide_cylinder_distance.h"

namespace concave_distance::round_distance_test {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test::roundShape;
using test::WideVector;

std::vector<RoundShape> allShapes() {
  return {test::sphereOf(0.4), roundShape(RoundKind::Capsule, 0.2, 0.5),
          roundShape(RoundKind::Cylinder, 0.3, 0.5), roundShape(RoundKind::Cylinder, 0.5, 0.02),
          roundShape(RoundKind::Cylinder, 0.01, 0.8)};
}

/// Least of a convex function on [0, 1], to the roundings of its values.
template <typename Function>
long double leastOf(const Function& f) {
  long double low = 0;
  long double high = 1;
  for (int i = 0; i < 110; ++i) {
    const long double l = low + (high - low) / 3;
    const long double r = high - (high - low) / 3;
    (f(l) < f(r) ? high : low) = f(l) < f(r) ? r : l;
  }
  return std::min({f(low), f((low + high) / 2), f(high), f(0.0L), f(1.0L)});
}

long double wideLowest(const RoundShape& shape, const TrianglePoints& t) {
  const WideVector a = t[0].cast<long double>();
  const WideVector b = t[1].cast<long double>();
  const WideVector c = t[2].cast<long double>();
  return leastOf([&](long double u) {
    const WideVector from = a + u * (b - a);
    const WideVector to = a + u * (c - a);
    return leastOf([&](long double v) { return test::wideSignedDistance(shape, from + v * (to - from)); });
  });
}

TEST(RoundKernels, TheLowestPointOfATriangleIsThatOfASearchInLongDouble) {
  RandomEngine engine(41);
  double worst = 0.0;
  for (const RoundShape& shape : allShapes()) {
    for (int i = 0; i < 60; ++i) {
      TrianglePoints triangle;
      const double size = std::pow(10.0, test::uniformIn(engine, -2.0, 1.0));
      const Vector3d middle = test::uniformInCube(engine, 1.0);
      for (Vector3d& corner : triangle) corner = middle + test::uniformInCube(engine, size);
      if (i % 5 == 0) {
        for (Vector3d& corner : triangle) corner.z() = middle.z();  // across the axis
      } else if (i % 5 == 1) {
        for (Vector3d& corner : triangle) corner.x() = middle.x();  // along it
      }
      const LowestPoint found = lowestOnTriangle(shape, triangle);
      const double truth = static_cast<double>(wideLowest(shape, triangle));
      const double scale = 1.0 + 1.8 * size;
      worst = std::max(worst, std::abs(found.value - truth) / scale);
      EXPECT_NEAR(found.value, detail::signedDistance(shape, found.point), 1e-15 * scale);
      EXPECT_LE(lowerBoundOnTriangle(shape, triangle), truth + 1e-15 * scale);
    }
  }
  EXPECT_LT(worst, kRoundDistanceError);
}

TEST(RoundKernels, ATriangleWithoutAreaIsASegmentOrAPoint) {
  const RoundShape cylinder = roundShape(RoundKind::Cylinder, 1.0, 0.5);
  const Vector3d far(3.0, 0.0, 0.0);
  const Vector3d near(2.0, 0.0, 0.0);
  EXPECT_DOUBLE_EQ(lowestOnTriangle(cylinder, {far, near, 0.5 * (far + near)}).value, 1.0);
  EXPECT_DOUBLE_EQ(lowestOnTriangle(cylinder, {far, far, far}).value, 2.0);
}

TEST(RoundKernels, GradientsAreThoseOfTheDistance) {
  RandomEngine engine(3);
  for (const RoundShape& shape : allShapes()) {
    for (int i = 0; i < 200; ++i) {
      const Vector3d p = test::uniformInCube(engine, 1.0);
      const Vector3d out = detail::outwardDirection(shape, p);
      const double here = detail::signedDistance(shape, p);
      EXPECT_NEAR(out.norm(), 1.0, 1e-14);
      // Convex: no point is below the tangent plane.
      for (int k = 0; k < 5; ++k) {
        const Vector3d q = test::uniformInCube(engine, 1.0);
        EXPECT_GE(detail::signedDistance(shape, q), here + out.dot(q - p) - 1e-14);
      }
      if (here > 0.0) {
        EXPECT_NEAR(detail::signedDistance(shape, detail::surfacePoint(shape, p)), 0.0, 1e-14);
      }
    }
  }
}

TEST(RoundPairDistance, SpheresAndCapsulesHaveClosedForms) {
  const RoundShape small = test::sphereOf(0.25);
  const RoundShape capsule = roundShape(RoundKind::Capsule, 0.5, 1.0);
  EXPECT_NEAR(roundPairDistance(small, test::sphereOf(1.0), test::translation({3, 4, 0})).distance, 3.75,
              1e-15);
  EXPECT_NEAR(roundPairDistance(capsule, small, test::translation({2, 0, 0.7})).distance, 1.25, 1e-15);
  EXPECT_NEAR(roundPairDistance(small, capsule, test::translation({0, 3, 5})).distance, 4.25, 1e-15);
  // Crossed axes, 2 apart.
  Isometry3d crossed(Eigen::AngleAxisd(0.5 * 3.14159265358979323846, Vector3d::UnitX()));
  crossed.translation() = Vector3d(2.0, 0.1, 0.2);
  const RoundPairDistance found = roundPairDistance(capsule, capsule, crossed);
  EXPECT_NEAR(found.distance, 1.0, 1e-15);
  EXPECT_NEAR((found.point_a - Vector3d(0.5, 0.0, 0.2)).norm(), 0.0, 1e-12);
  EXPECT_TRUE(roundPairDistance(capsule, small, test::translation({0.7, 0, 0})).overlap);
}

TEST(RoundPairDistance, CylindersHaveClosedForms) {
  const RoundShape a = roundShape(RoundKind::Cylinder, 1.0, 0.5);
  const RoundShape b = roundShape(RoundKind::Cylinder, 0.5, 2.0);
  EXPECT_NEAR(roundPairDistance(a, b, test::translation({2, 0, 0.3})).distance, 0.5, 1e-13);
  EXPECT_NEAR(roundPairDistance(a, b, test::translation({0.2, 0.1, 3})).distance, 0.5, 1e-13);
  EXPECT_NEAR(roundPairDistance(a, b, test::translation({4.5, 0, 6.5})).distance, 5.0, 1e-13);
  Isometry3d lying(Eigen::AngleAxisd(0.5 * 3.14159265358979323846, Vector3d::UnitX()));
  lying.translation() = Vector3d(0.3, 0.0, 1.5);
  EXPECT_NEAR(roundPairDistance(a, b, lying).distance, 0.5, 1e-13);
  lying.translation() = Vector3d(0.3, 0.0, 0.9);
  EXPECT_TRUE(roundPairDistance(a, b, lying).overlap);
}

TEST(RoundPairDistance, CylindersAnyhowAreBracketedAndAgreeWithFineMeshes) {
  RandomEngine engine(17);
  const RoundShape a = roundShape(RoundKind::Cylinder, 0.3, 0.5, 1e-4);
  const RoundShape b = roundShape(RoundKind::Cylinder, 0.4, 0.1, 1e-4);
  const auto mesh_a = test::makeRoundBody(a, false);
  const auto mesh_b = test::makeRoundBody(b, false);
  CertificateWorkspace workspace;
  int apart = 0;
  for (int i = 0; i < 100; ++i) {
    const Isometry3d pose = test::randomPose(engine, 1.2);
    const RoundPairDistance found = roundPairDistance(a, b, pose);
    const DistanceCertificate meshes = certifyDistance(*mesh_a, *mesh_b, pose, nullptr, 0, {}, workspace);
    EXPECT_LE(found.distance, meshes.distance + 1e-13) << i;
    EXPECT_GE(found.distance, meshes.distance - 2.1e-4) << i;
    if (found.overlap) continue;
    ++apart;
    EXPECT_NEAR(found.lower_bound, found.distance, 1e-13) << i;
    EXPECT_NEAR(detail::signedDistance(a, found.point_a), 0.0, 1e-12) << i;
    EXPECT_NEAR((found.point_b - found.point_a).norm(), found.distance, 1e-13) << i;
  }
  EXPECT_GT(apart, 50);
}

/// Stacked, side by side or anyhow, with axes and faces as nearly parallel as doubles can have them.
Isometry3d nearlyAligned(RandomEngine& engine, const RoundShape& a, const RoundShape& b, int i) {
  const auto tiny = [&] { return std::pow(10.0, test::uniformIn(engine, -17.0, -3.0)); };
  const Vector3d around = test::uniformInCube(engine, 1.0).normalized();
  Isometry3d pose(Eigen::AngleAxisd(i % 11 == 0 ? 0.0 : tiny(), around));
  if (i % 4 == 3) pose = pose * Eigen::AngleAxisd(0.5 * kPi, Vector3d::UnitX());
  const double gap = std::pow(10.0, test::uniformIn(engine, -15.0, 0.5));
  const double aside = (i % 2 == 0 ? tiny() : 1.0) * (a.radius + b.radius);
  pose.translation() = aside * test::uniformInCube(engine, 1.0);
  const double reach = i % 4 == 3 ? b.radius : b.half_length;
  if (i % 4 != 2) {
    pose.translation().z() = a.half_length + reach + gap;
  } else {
    pose.translation().x() = a.radius + b.radius + gap;
  }
  return pose;
}

TEST(RoundPairDistance, NearlyAlignedCylindersAreWithinTheBoundEitherWayRound) {
  RandomEngine engine(33);
  double worst = 0.0;
  double worst_bound = 0.0;
  double worst_points = 0.0;
  int apart = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto size = [&] { return std::pow(10.0, test::uniformIn(engine, -2.0, 0.0)); };
    const RoundShape a = roundShape(RoundKind::Cylinder, size(), size());
    const RoundShape b = roundShape(RoundKind::Cylinder, size(), size());
    const Isometry3d pose = i % 8 == 7 ? test::randomPose(engine, 3.0) : nearlyAligned(engine, a, b, i);
    const auto truth = static_cast<double>(test::WideCylinderDistance(a, b, pose).find());
    const double scale = pose.translation().norm() + detail::reachOf(a) + detail::reachOf(b);
    if (truth > kRoundDistanceError * scale) ++apart;
    const RoundPairDistance swapped = roundPairDistance(b, a, pose.inverse(Eigen::Isometry));
    for (const RoundPairDistance& found : {roundPairDistance(a, b, pose), swapped}) {
      const double error = std::abs(found.distance - std::max(0.0, truth)) / scale;
      const double bound = std::abs(found.lower_bound - std::max(0.0, truth)) / scale;

      worst = std::max(worst, error);
      worst_bound = std::max(worst_bound, bound);
      if (found.overlap) continue;
      worst_points =
          std::max({worst_points, std::abs((found.point_b - found.point_a).norm() - found.distance) / scale});
    }
  }
  EXPECT_GT(apart, 2000);
  EXPECT_LE(worst, kRoundDistanceError);
  EXPECT_LE(worst_bound, kRoundDistanceError);
  EXPECT_LE(worst_points, kRoundDistanceError);
}

double everyTriangle(const RoundAndMesh& pair) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < pair.mesh.surface().triangleCount(); ++t)
    least = std::min(least, lowestOnTriangle(pair.shape, pair.triangleInShape(TriangleIndex{t})).value);
  return least;
}

TEST(RoundCertificate, TheProofFindsTheLeastOfAllTriangles) {
  RandomEngine engine(5);
  int penetrating = 0;
  for (const RoundShape& shape : allShapes()) {
    RoundShape placed = shape;
    placed.body_from_shape = test::randomPose(engine, 0.3);
    const auto round = test::makeRoundBody(placed);
    for (std::uint32_t i = 0; i < 40; ++i) {
      const auto mesh = test::makeBody(test::concaveShape(i));
      const Isometry3d pose = test::randomPose(engine, 1.2);
      const DistanceCertificate found = certifyRoundDistance(*round, *mesh, pose, nullptr, 0, {});
      const double truth = everyTriangle(RoundAndMesh(placed, *mesh, pose.inverse(Eigen::Isometry)));
      if (truth <= 0.0) {
        ++penetrating;
        EXPECT_EQ(found.status, CertificateStatus::Penetrating);
        continue;
      }
      EXPECT_EQ(found.status, CertificateStatus::Proven);
      EXPECT_NEAR(found.distance, truth, 1e-14);
      EXPECT_LE(found.lower_bound, truth);
      EXPECT_GE(found.lower_bound, truth - 1e-12);
      EXPECT_NEAR((found.witness.point_a_in_a - found.witness.point_b_in_a).norm(), truth, 1e-13);
      const DistanceCertificate swapped =
          certifyRoundDistance(*mesh, *round, pose.inverse(Eigen::Isometry), nullptr, 0, {});
      EXPECT_NEAR(swapped.distance, truth, 1e-13);
    }
  }
  EXPECT_GT(penetrating, 10);
}

TEST(RoundCertificate, ATolerantProofHoldsItsTolerance) {
  RandomEngine engine(9);
  const auto round = test::makeRoundBody(roundShape(RoundKind::Cylinder, 0.2, 0.4));
  const auto mesh = test::makeBody(test::makeComb(8));
  CertificateRequest request;
  request.absolute_tolerance = 0.05;
  for (int i = 0; i < 50; ++i) {
    const Isometry3d pose = test::randomPose(engine, 2.0);
    const DistanceCertificate exact = certifyRoundDistance(*round, *mesh, pose, nullptr, 0, {});
    const DistanceCertificate found = certifyRoundDistance(*round, *mesh, pose, nullptr, 0, request);
    if (exact.status == CertificateStatus::Penetrating) continue;
    EXPECT_LE(found.lower_bound, exact.distance);
    EXPECT_GE(found.distance, exact.distance);
    EXPECT_LE(found.distance - found.lower_bound, 0.05 + 1e-12);
  }
}

TEST(RoundCertificate, FarFromTheOriginItLosesNoMoreThanThePose) {
  const auto round = test::makeRoundBody(test::sphereOf(0.5));
  const auto box = test::makeBody(makeBox({1.0, 1.0, 1.0}));
  RoundShape far = test::sphereOf(0.5);
  far.body_from_shape.translation() = Vector3d(1e6, -1e6, 1e6);
  const auto moved = test::makeRoundBody(far);
  const DistanceCertificate found =
      certifyRoundDistance(*box, *moved, test::translation({1.25 - 1e6, 1e6, -1e6}), nullptr, 0, {});
  EXPECT_NEAR(found.distance, 0.25, 1e-9);
  EXPECT_LE(found.lower_bound, 0.25);
}

TEST(RoundCertificate, WhoHoldsWhomIsKnown) {
  const auto ball = test::makeRoundBody(test::sphereOf(0.5));
  const auto hall = test::makeBody(makeBox({4.0, 4.0, 4.0}));
  const auto grain = test::makeBody(makeBox({0.1, 0.1, 0.1}));
  const Isometry3d pose = test::translation({0.1, 0.0, 0.0});
  EXPECT_TRUE(isRoundContained(*hall, *ball, pose));
  EXPECT_NEAR(certifyRoundDistance(*hall, *ball, pose, nullptr, 0, {}).distance, 1.4, 1e-14);
  EXPECT_TRUE(isRoundContained(*ball, *grain, pose));
  EXPECT_NEAR(certifyRoundDistance(*ball, *grain, pose, nullptr, 0, {}).distance,
              0.5 - Vector3d(0.15, 0.05, 0.05).norm(), 1e-14);
  EXPECT_FALSE(isRoundContained(*ball, *grain, test::translation({0.7, 0.0, 0.0})));
}

}  // namespace
}  // namespace concave_distance::round_distance_test
