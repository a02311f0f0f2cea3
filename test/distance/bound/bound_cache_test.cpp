#include "distance/bound/bound_cache.h"

#include <gtest/gtest.h>

#include "distance/bound/certificate.h"
#include "support/body_pairs.h"
#include "support/enumeration.h"

namespace concave_distance::bound_cache_test {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test::makeBody;

using Body = std::shared_ptr<const BodyMesh>;

/// B on a loop around A while it turns.
Isometry3d onLoop(double t, double reach) {
  Isometry3d pose(Eigen::AngleAxisd(2.0 * t, Vector3d(1, 2, -1).normalized()));
  pose.translation() = reach * Vector3d(std::cos(3.0 * t), std::sin(3.0 * t), 0.3 * std::sin(5.0 * t));
  return pose;
}

TEST(BoundCache, ProvesWhatAFreshProofProves) {
  for (std::uint32_t shape = 0; shape < 6; ++shape) {
    const Body a = makeBody(test::concaveShape(shape));
    const Body b = makeBody(test::concaveShape(shape + 1));
    for (const int steps : {12, 100, 600}) {
      CertificateWorkspace workspace;
      BoundCache front;
      TrianglePair start{};
      for (int k = 0; k < steps; ++k) {
        const Isometry3d pose = onLoop(static_cast<double>(k) / steps, 0.9);
        const DistanceCertificate kept =
            certifyDistance(*a, *b, pose, &start, 1, CertificateRequest(), workspace, &front);
        const DistanceCertificate fresh =
            certifyDistance(*a, *b, pose, &start, 1, CertificateRequest(), workspace);
        const double error = kProofError * proofScale(*a, *b, pose);
        ASSERT_NEAR(kept.distance, fresh.distance, error) << shape << ' ' << steps << ' ' << k;
        ASSERT_EQ(kept.status, fresh.status);
        ASSERT_NEAR(kept.lower_bound, fresh.lower_bound, error);
        start = {kept.witness.triangle_a, kept.witness.triangle_b};
      }
    }
  }
}

TEST(BoundCache, IsNotFooledByStaleStartsLeapsAndTolerances) {
  RandomEngine engine(5);
  int reopened = 0;
  for (int round = 0; round < 30; ++round) {
    const Body a = makeBody(test::concaveShape(static_cast<std::uint32_t>(round)));
    const Body b = makeBody(test::concaveShape(static_cast<std::uint32_t>(round / 5)));
    CertificateWorkspace workspace;
    BoundCache front;
    Isometry3d pose = test::randomPose(engine, 1.0);
    for (int k = 0; k < 60; ++k) {
      const double step = std::pow(10.0, -4.0 * uniformUnit(engine));
      Isometry3d move(
          Eigen::AngleAxisd(step * uniformUnit(engine), test::uniformInCube(engine, 1.0).normalized()));
      move.translation() = test::uniformInCube(engine, step);
      pose = move * pose;
      if (pose.translation().norm() > 2.0) pose = test::randomPose(engine, 1.0);  // a leap
      CertificateRequest request;
      if (k % 3 == 0) request.relative_tolerance = 0.3 * uniformUnit(engine);
      WorkLimit limit(WorkLimit::Clock::now(), 1e-5, std::numeric_limits<std::size_t>::max(), nullptr);
      if (k % 7 == 0) request.limit = &limit;
      // Any start: triangle 0 is as good as none.
      const TrianglePair start{};
      const bool was_valid = front.valid();
      const DistanceCertificate found = certifyDistance(*a, *b, pose, &start, 1, request, workspace, &front);
      reopened += was_valid ? 1 : 0;
      const double exact = std::sqrt(test::enumerateTrianglePairs(*a, *b, pose).squared_distance);
      const double error = kProofError * proofScale(*a, *b, pose);
      ASSERT_LE(found.lower_bound, exact);
      ASSERT_GE(found.distance, exact - error);
      if (found.status == CertificateStatus::Proven) {
        ASSERT_NEAR(found.distance, exact, error);
      }
      if (found.status == CertificateStatus::Tolerance) {
        ASSERT_GE(found.lower_bound, (1.0 - request.relative_tolerance) * found.distance - error);
      }
      if (found.status != CertificateStatus::Budget) {
        EXPECT_EQ(found.status == CertificateStatus::Penetrating, exact == 0.0);
      }
    }
  }
  EXPECT_GT(reopened, 500);
}

TEST(BoundCache, ProvesForNothingAtRestAndForLittleInSmallSteps) {
  const Body a = makeBody(test::makeBumpy(makeSphere(0.5, 1e-4)));
  CertificateWorkspace workspace;
  BoundCache front;
  TrianglePair start{};
  const auto prove = [&](double t) {
    const DistanceCertificate found =
        certifyDistance(*a, *a, onLoop(t, 1.15), &start, 1, CertificateRequest(), workspace, &front);
    start = {found.witness.triangle_a, found.witness.triangle_b};
    return found.cost.box_bounds;
  };
  const std::uint32_t fresh = prove(0.5);
  EXPECT_GT(fresh, 100U);
  for (int k = 0; k < 100; ++k) EXPECT_EQ(prove(0.5), 0U);
  std::uint64_t small = 0;
  for (int k = 0; k < 100; ++k) small += prove(0.5 + 1e-6 * k);
  EXPECT_LT(small, 100U * fresh / 20U);
}

TEST(BoundCache, BeginsAnewOnceCleared) {
  const Body a = makeBody(test::makeComb(3));
  const Body b = makeBody(test::makeHook());
  CertificateWorkspace workspace;
  BoundCache front;
  const TrianglePair start{};
  // Linked, so that no plane parts them: what one plane parts needs no front.
  const Body ring = makeBody(test::makeRing(0.5, 0.1, 14, 6));
  Isometry3d linked = Isometry3d::Identity();
  linked.linear() = Eigen::AngleAxisd(0.5 * M_PI, Eigen::Vector3d::UnitX()).toRotationMatrix();
  linked.translation().x() = 0.5;
  certifyDistance(*ring, *ring, linked, &start, 1, CertificateRequest(), workspace, &front);
  EXPECT_TRUE(front.valid());
  front.clear();
  EXPECT_FALSE(front.valid());
  const Isometry3d pose = onLoop(0.2, 1.2);
  const DistanceCertificate other =
      certifyDistance(*a, *b, pose, &start, 1, CertificateRequest(), workspace, &front);
  EXPECT_NEAR(other.distance, std::sqrt(test::enumerateTrianglePairs(*a, *b, pose).squared_distance), 1e-13);
}

}  // namespace
}  // namespace concave_distance::bound_cache_test
