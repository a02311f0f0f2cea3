// Meshes at the ends of what there is: a million triangles, files in other units, bodies without extent.
#include <gtest/gtest.h>

#include "concave_distance/base/error.h"
#include "concave_distance/mesh/import/export_mesh.h"
#include "concave_distance/mesh/import/import_mesh.h"
#include "concave_distance/mesh/repair/repair_mesh.h"
#include "distance/bound/certificate.h"
#include "support/body_pairs.h"
#include "support/temporary_folder.h"

namespace concave_distance::extreme_mesh_test {
namespace {

using Eigen::Vector3d;

DistanceCertificate certify(const BodyMesh& a, const BodyMesh& b, const Eigen::Isometry3d& pose) {
  CertificateWorkspace workspace;
  return certifyDistance(a, b, pose, nullptr, 0, CertificateRequest(), workspace);
}

TEST(ExtremeMesh, OneRaisedVertexAmongAMillionTrianglesIsFound) {
  // A flat sheet, but for one vertex 1e-6 above it: nothing else tells that pair from its neighbours.
  constexpr std::uint32_t kSide = 708;
  const SurfaceMesh flat = test::makeSheet(kSide, kSide, 1e-3);
  std::vector<Vector3d> vertices = flat.vertices();
  const std::size_t raised = 431 * (kSide + 1) + 217;
  vertices[raised].z() = 1e-6;
  const auto sheet = test::makeBody(SurfaceMesh(std::move(vertices), flat.triangles(), "sheet"));
  ASSERT_GT(sheet->surface().triangleCount(), 1'000'000U);
  const auto box = test::makeBody(test::makeCuboid({-1, -1, 0.25}, {2, 2, 0.5}));
  const Eigen::Isometry3d identity = Eigen::Isometry3d::Identity();
  const DistanceCertificate found = certify(*sheet, *box, identity);
  const double error = kProofError * proofScale(*sheet, *box, identity);
  EXPECT_NEAR(found.distance, 0.25 - 1e-6, error);
  EXPECT_GE(found.lower_bound, 0.25 - 1e-6 - 2.0 * error);
  EXPECT_LE((found.witness.point_a_in_a - sheet->surface().vertices()[raised]).norm(), 1e-9);
}

TEST(ExtremeMesh, AFileInOtherUnitsIsTheSameBody) {
  const test::TemporaryFolder folder;
  const SurfaceMesh hook = test::makeHook();
  const auto comb = test::makeBody(test::makeComb(3));
  Eigen::Isometry3d pose(Eigen::AngleAxisd(1.3, Vector3d(0.2, 0.9, -0.5).normalized()));
  pose.translation() = Vector3d(0.2, 0.9, 0.3);
  const double plain = certify(*comb, *test::makeBody(hook), pose).distance;
  for (const double unit : {1e-3, 1e3}) {
    for (const char* format : {"hook.stl", "hook.obj", "hook.ply"}) {
      std::vector<Vector3d> vertices = hook.vertices();
      for (Vector3d& v : vertices) v /= unit;
      exportMesh(SurfaceMesh(vertices, hook.triangles(), "hook"), folder.path(format));
      const TriangleSoup soup = importMesh(folder.path(format), Vector3d::Constant(unit));
      const auto body = test::makeBody(repairMesh(soup, RepairOptions(), format).mesh);
      // Import rounds coordinates to single precision.
      EXPECT_NEAR(certify(*comb, *body, pose).distance, plain, 4.0 * 6e-8 * hook.diameter())
          << unit << format;
    }
  }
}

TEST(ExtremeMesh, ABodyWithoutExtentInDoublePrecisionIsRefused) {
  for (const double size : {1e-310, 5e-324, 1e-170}) {
    TriangleSoup soup;
    soup.vertices = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}};
    soup.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    EXPECT_THROW(repairMesh(soup, RepairOptions(), "grain"), Error) << size;
  }
}

}  // namespace
}  // namespace concave_distance::extreme_mesh_test
