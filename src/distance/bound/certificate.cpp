#include "certificate.h"

#include "base/constants.h"
#include "branch_and_bound.h"

namespace concave_distance {

std::string_view toString(CertificateStatus status) {
  switch (status) {
    case CertificateStatus::Proven:
      return "proven";
    case CertificateStatus::Tolerance:
      return "tolerance";
    case CertificateStatus::Budget:
      return "budget";
    case CertificateStatus::Penetrating:
      return "penetrating";
  }
  return "unknown";
}

double proofScale(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b) {
  const Eigen::Vector3d offset = a_from_b * b.hierarchy().origin() - a.hierarchy().origin();
  const double far =
      a.hierarchy().origin().norm() + b.hierarchy().origin().norm() + a_from_b.translation().norm();
  return a.hierarchy().reach() + b.hierarchy().reach() + offset.norm() + kPoseShare * far;
}

DistanceCertificate certifyDistance(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& a_from_b,
                                    const TrianglePair* starts, std::size_t start_count,
                                    const CertificateRequest& request, CertificateWorkspace& workspace,
                                    BoundCache* cache) {
  // If products of coordinates would overflow, nothing is proven: bound 0, distance infinite.
  if (!a_from_b.matrix().allFinite() || a_from_b.translation().cwiseAbs().maxCoeff() > kLargestCoordinate) {
    return {};
  }
  return detail::BranchAndBound(a, b, a_from_b, request, workspace, cache).run(starts, start_count);
}

}  // namespace concave_distance
