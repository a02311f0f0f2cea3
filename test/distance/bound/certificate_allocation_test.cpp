#include <gtest/gtest.h>

#include "distance/bound/certificate.h"
#include "support/body_pairs.h"
#include "support/count_allocations.h"

namespace concave_distance::certificate_allocation_test {
namespace {

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
}  // namespace concave_distance::certificate_allocation_test
