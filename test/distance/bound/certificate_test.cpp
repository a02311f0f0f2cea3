#include "distance/bound/certificate.h"

#include <gtest/gtest.h>

#include "distance/kernels/surface_walk.h"
#include "support/body_pairs.h"
#include "support/count_allocations.h"
#include "support/enumeration.h"

namespace concave_distance::certificate_test {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test::makeBody;

using Body = std::shared_ptr<const BodyMesh>;

DistanceCertificate certify(const Body& a, const Body& b, const Isometry3d& pose,
                            const CertificateRequest& request = CertificateRequest()) {
  CertificateWorkspace workspace;
  return certifyDistance(*a, *b, pose, nullptr, 0, request, workspace);
}

double truth(const Body& a, const Body& b, const Isometry3d& pose) {
  return std::sqrt(test::enumerateTrianglePairs(*a, *b, pose).squared_distance);
}

TEST(Certificate, IsTheDistanceOfBruteForceWithItsProof) {
  RandomEngine engine(1);
  for (std::uint32_t round = 0; round < 120; ++round) {
    const Body a = makeBody(test::concaveShape(round));
    const Body b = makeBody(test::concaveShape(round / 6));
    const Isometry3d pose = test::randomPose(engine, 1.5);
    const double exact = truth(a, b, pose);
    const DistanceCertificate found = certify(a, b, pose);
    const double error = kProofError * proofScale(*a, *b, pose);
    EXPECT_NEAR(found.distance, exact, 0.5 * error);
    EXPECT_LE(found.lower_bound, exact);
    if (exact > 0.0) {
      EXPECT_EQ(found.status, CertificateStatus::Proven);
      EXPECT_GE(found.lower_bound, found.distance - 1.01 * error);
      EXPECT_NEAR((found.witness.point_b_in_a - found.witness.point_a_in_a).norm(), found.distance, error);
    } else {
      EXPECT_EQ(found.status, CertificateStatus::Penetrating);
      EXPECT_EQ(found.distance, 0.0);
    }
  }
}

TEST(Certificate, DoesNotDependOnTheStarts) {
  RandomEngine engine(2);
  for (std::uint32_t round = 0; round < 60; ++round) {
    const Body a = makeBody(test::concaveShape(round));
    const Body b = makeBody(test::concaveShape(round + 1));
    const Isometry3d pose = test::randomPose(engine, 1.5);
    const DistanceCertificate cold = certify(a, b, pose);
    CertificateWorkspace workspace;
    const TrianglePair starts[2] = {
        {TriangleIndex{uniformIndex(engine, static_cast<std::uint32_t>(a->surface().triangleCount()))},
         TriangleIndex{uniformIndex(engine, static_cast<std::uint32_t>(b->surface().triangleCount()))}},
        {cold.witness.triangle_a, cold.witness.triangle_b}};
    const double error = kProofError * proofScale(*a, *b, pose);
    const DistanceCertificate bad = certifyDistance(*a, *b, pose, starts, 1, CertificateRequest(), workspace);
    EXPECT_NEAR(bad.distance, cold.distance, error);
    const DistanceCertificate good =
        certifyDistance(*a, *b, pose, starts, 2, CertificateRequest(), workspace);
    EXPECT_NEAR(good.distance, cold.distance, error);
    EXPECT_FALSE(good.improved);
  }
}

TEST(Certificate, SaysWhenAStartWasNotTheClosest) {
  const Body comb = makeBody(test::makeComb(5));
  Isometry3d pose = test::translation(Vector3d(1.225, 0.7, 0.02));  // the teeth of one between the other's
  pose.linear() = Eigen::AngleAxisd(3.14, Vector3d::UnitZ()).toRotationMatrix();
  const DistanceCertificate best = certify(comb, comb, pose);
  CertificateWorkspace workspace;
  int improved = 0;
  int as_close = 0;
  const std::size_t count = comb->surface().triangleCount();
  for (std::size_t i = 0; i < count * count; i += 7) {
    const TrianglePair start{TriangleIndex{i / count}, TriangleIndex{i % count}};
    RefinementWorkspace refinement;
    const double distance_there =
        std::sqrt(refineWitness(*comb, *comb, pose, start.a, start.b, refinement).witness.squared_distance);
    const DistanceCertificate found =
        certifyDistance(*comb, *comb, pose, &start, 1, CertificateRequest(), workspace);
    const bool farther = distance_there > best.distance + 1e-9;
    EXPECT_EQ(found.improved, farther);
    improved += farther ? 1 : 0;
    as_close += farther ? 0 : 1;
  }
  EXPECT_GT(improved, 0);
  EXPECT_GT(as_close, 0);
}

TEST(Certificate, HoldsItsTolerances) {
  RandomEngine engine(3);
  for (std::uint32_t round = 0; round < 60; ++round) {
    const Body a = makeBody(test::concaveShape(round));
    const Body b = makeBody(test::concaveShape(round + 2));
    Isometry3d pose = test::randomPose(engine, 1.0);
    pose.translation().x() += 3.0;
    const double exact = truth(a, b, pose);
    ASSERT_GT(exact, 0.0);
    for (const double tolerance : {1e-6, 1e-3, 0.1, 0.7}) {
      CertificateRequest absolute;
      absolute.absolute_tolerance = tolerance;
      CertificateRequest relative;
      relative.relative_tolerance = tolerance;
      for (const CertificateRequest& request : {absolute, relative}) {
        const DistanceCertificate found = certify(a, b, pose, request);
        const double allowed =
            std::max(request.absolute_tolerance, request.relative_tolerance * found.distance);
        EXPECT_LE(found.lower_bound, exact);
        EXPECT_GE(found.distance, exact * (1.0 - 1e-12));
        EXPECT_GE(found.lower_bound, std::max(0.0, found.distance - allowed) * (1.0 - 1e-12));
        EXPECT_LE(found.cost.box_bounds, certify(a, b, pose).cost.box_bounds);
      }
    }
  }
}

TEST(Certificate, StopsWithValidBoundsWhenTheTimeIsUp) {
  const Body a = makeBody(test::makeBumpy(makeSphere(0.5, 1e-4)));
  RandomEngine engine(4);
  int stopped = 0;
  for (int round = 0; round < 40; ++round) {
    Isometry3d pose = test::randomPose(engine, 0.05);
    pose.translation().x() += 1.2;
    const DistanceCertificate full = certify(a, a, pose);
    double last = 0.0;
    for (const double budget : {0.0, 2e-6, 1e-5, 1000.0}) {
      CertificateRequest request;
      WorkLimit limit(WorkLimit::Clock::now(), budget, std::numeric_limits<std::size_t>::max(), nullptr);
      request.limit = &limit;
      const DistanceCertificate found = certify(a, a, pose, request);
      EXPECT_LE(found.lower_bound, full.distance);
      EXPECT_GE(found.distance, full.distance - 1e-12);
      stopped += found.status == CertificateStatus::Budget ? 1 : 0;
      last = found.lower_bound;
    }
    EXPECT_NEAR(last, full.lower_bound, 1e-12);
  }
  EXPECT_GT(stopped, 0);
}

TEST(Certificate, OfConvexBodiesLooksAtNextToNothing) {
  const Body a = makeBody(makeSphere(0.5, 1e-4));
  RandomEngine engine(6);
  for (int round = 0; round < 20; ++round) {
    Isometry3d pose = test::randomPose(engine, 0.1);
    pose.translation().x() += 1.3;
    const DistanceCertificate found = certify(a, a, pose);
    CertificateWorkspace workspace;
    const TrianglePair start{found.witness.triangle_a, found.witness.triangle_b};
    EXPECT_EQ(certifyDistance(*a, *a, pose, &start, 1, CertificateRequest(), workspace).cost.box_bounds, 0U);
  }
}

TEST(Certificate, NamesTheTrianglesThatMeet) {
  const Body a = makeBody(test::makeCuboid({-1, -1, -1}, {1, 1, 1}));
  const Body b = makeBody(test::makeCuboid({-0.2, -0.2, 0.5}, {0.2, 0.2, 3}));
  const DistanceCertificate found = certify(a, b, Isometry3d::Identity());
  EXPECT_EQ(found.status, CertificateStatus::Penetrating);
  EXPECT_EQ(found.distance, 0.0);
  EXPECT_EQ(found.lower_bound, 0.0);
  const TrianglePoints ta = trianglePoints(a->surface(), found.witness.triangle_a);
  const TrianglePoints tb = trianglePoints(b->surface(), found.witness.triangle_b);
  // Up to the kernel's error, in coordinates up to 3.
  EXPECT_LE(std::sqrt(triangleDistance(ta, tb).squared_distance), 3.0 * kTriangleDistanceError);
}

TEST(Certificate, AllocatesNothingOnceItsWorkspaceHasGrown) {
  const auto a = test::makeBody(makeSphere(0.5, 1e-3));
  CertificateWorkspace workspace;
  const Eigen::Isometry3d pose = test::translation(Eigen::Vector3d(1.3, 0.2, 0.1));
  const TrianglePair start{};
  certifyDistance(*a, *a, pose, &start, 1, CertificateRequest(), workspace);
  const std::size_t before = allocations;
  certifyDistance(*a, *a, pose, &start, 1, CertificateRequest(), workspace);
  EXPECT_EQ(allocations, before);
}

}  // namespace
}  // namespace concave_distance::certificate_test
